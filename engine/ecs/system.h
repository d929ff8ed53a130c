#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/ecs/access.h"
#include "engine/ecs/commands.h"
#include "engine/ecs/query.h"
#include "engine/ecs/world.h"

namespace vellus {

/// A system's access to a resource: Res<T> to write, Res<const T> to read.
template <class T>
class Res {
  public:
    explicit Res(T& resource) noexcept : resource_(&resource) {}
    T& operator*() const noexcept { return *resource_; }
    T* operator->() const noexcept { return resource_; }

  private:
    T* resource_;
};

/// How one kind of system parameter declares its access, and what is passed for it.
template <class P>
struct SystemParameter {
    static_assert(
        sizeof(P) == 0,
        "a system takes Query<...>, Res<...>, Commands& or World& (README of engine/ecs)");
};

template <class... Terms>
struct SystemParameter<Query<Terms...>> {
    using State = Query<Terms...>;
    static void declare(Access& access) { access.queries.push_back(query_access<Terms...>()); }
    static State prepare(World& world, Commands&) { return world.query<Terms...>(); }
    static State& pass(State& state) { return state; }
};

template <class T>
struct SystemParameter<Res<T>> {
    using Resource = std::remove_const_t<T>;
    using State = Res<T>;
    static void declare(Access& access) {
        access.resources.push_back(
            {kTypeIndex<ResourceFamily, Resource>, type_name<Resource>(), !std::is_const_v<T>});
    }
    static State prepare(World& world, Commands&) { return State(world.resource<Resource>()); }
    static State& pass(State& state) { return state; }
};

template <>
struct SystemParameter<Commands> {
    using State = Commands*;
    static void declare(Access& access) { access.commands = true; }
    static State prepare(World&, Commands& commands) { return &commands; }
    static Commands& pass(State& state) { return *state; }
};

template <>
struct SystemParameter<World> {
    using State = World*;
    static void declare(Access& access) { access.exclusive = true; }
    static State prepare(World& world, Commands&) { return &world; }
    static World& pass(State& state) { return *state; }
};

/// A function together with what its parameters resolve to in one world.
class System {
  public:
    virtual ~System() = default;
    [[nodiscard]] virtual Access access() const = 0;
    /// Looks the parameters up in the world; its resources must be there.
    virtual void prepare(World& world) = 0;
    virtual void run() = 0;
    Commands commands;
};

template <class Function, class... Parameters>
class FunctionSystem final : public System {
  public:
    explicit FunctionSystem(Function function) : function_(std::move(function)) {}

    [[nodiscard]] Access access() const override {
        Access access;
        (SystemParameter<std::remove_cvref_t<Parameters>>::declare(access), ...);
        return access;
    }
    void prepare(World& world) override {
        states_.emplace(
            SystemParameter<std::remove_cvref_t<Parameters>>::prepare(world, commands)...);
    }
    void run() override {
        std::apply(
            [this](auto&... states) {
                function_(SystemParameter<std::remove_cvref_t<Parameters>>::pass(states)...);
            },
            *states_);
    }

  private:
    Function function_;
    std::optional<std::tuple<typename SystemParameter<std::remove_cvref_t<Parameters>>::State...>>
        states_;
};

namespace detail {

template <class... Ps, class F>
std::unique_ptr<System> make_system_of(F function) {
    static_assert(((!std::is_same_v<Ps, Commands> && !std::is_same_v<Ps, World>)&&...),
                  "take Commands& and World& by reference");
    return std::make_unique<FunctionSystem<F, Ps...>>(std::move(function));
}

template <class F, class Call>
struct CallParameters;
template <class F, class R, class... Ps>
struct CallParameters<F, R (F::*)(Ps...)> {
    static auto make(F function) { return make_system_of<Ps...>(std::move(function)); }
};
template <class F, class R, class... Ps>
struct CallParameters<F, R (F::*)(Ps...) const> : CallParameters<F, R (F::*)(Ps...)> {};
template <class F, class R, class... Ps>
struct CallParameters<F, R (F::*)(Ps...) noexcept> : CallParameters<F, R (F::*)(Ps...)> {};
template <class F, class R, class... Ps>
struct CallParameters<F, R (F::*)(Ps...) const noexcept> : CallParameters<F, R (F::*)(Ps...)> {};

}  // namespace detail

template <class R, class... Ps>
std::unique_ptr<System> make_system(R (*function)(Ps...)) {
    return detail::make_system_of<Ps...>(function);
}
/// A lambda, or another object with one call operator.
template <class F>
requires std::is_class_v<F> std::unique_ptr<System> make_system(F function) {
    return detail::CallParameters<F, decltype(&F::operator())>::make(std::move(function));
}

}  // namespace vellus
