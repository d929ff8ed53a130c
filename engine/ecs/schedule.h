#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ecs/system.h"
#include "engine/platform/result.h"
#include "engine/platform/source_line.h"

namespace vellus {

using FunctionKey = void (*)();  // any system function's address

/// A declaration of order under construction; what Schedule::add returns.
class SystemOrder {
  public:
    /// By name of a system or set.
    SystemOrder& before(std::string_view name);
    SystemOrder& after(std::string_view name);
    template <class R, class... Ps>
    SystemOrder& before(R (*function)(Ps...)) {
        return order(reinterpret_cast<FunctionKey>(function), true);
    }
    template <class R, class... Ps>
    SystemOrder& after(R (*function)(Ps...)) {
        return order(reinterpret_cast<FunctionKey>(function), false);
    }
    /// Puts the system into a set; sets are ordered by before/after and Schedule::order.
    SystemOrder& in(std::string_view set);

  private:
    friend class Schedule;
    struct Constraint {
        FunctionKey function;
        std::string name;
        bool before;
    };
    SystemOrder& order(FunctionKey function, bool before);

    std::vector<Constraint> constraints_;
    std::vector<std::string> sets_;
};

/// Systems, and the order and parallelism derived from what they touch. Systems that do not
/// conflict run at the same time; two that conflict without a declared order are an error. A
/// system ordered after another sees that one's Commands: they are applied in between.
class Schedule {
  public:
    explicit Schedule(std::string name = "schedule");
    ~Schedule();
    Schedule(Schedule&&) noexcept;
    Schedule& operator=(Schedule&&) noexcept;

    /// Adds a function under its own name (from the program's symbols; FILE:LINE where stripped).
    /// The reference lasts as long as the schedule.
    template <class R, class... Ps>
    SystemOrder& add(R (*function)(Ps...), SourceLine where = SourceLine::current()) {
        return add_function(make_system(function), reinterpret_cast<FunctionKey>(function), where);
    }
    template <class F>
    SystemOrder& add(std::string_view name, F function) {
        return add_system(std::string(name), nullptr, make_system(std::move(function)));
    }
    /// Each set's systems run after those of the sets before it in the list.
    void order(std::initializer_list<std::string_view> sets);

    /// Derives the order and binds the systems to this world, whose resources must be there.
    /// Errors: ambiguities, cycles, unknown or doubled names, missing resources.
    Result<void> build(World& world);
    /// Runs all systems once, and applies all their Commands. Needs a successful build for this
    /// world since the last add.
    void run(World& world);

    /// The systems' names in an order that `run` respects; filled by build.
    [[nodiscard]] std::vector<std::string_view> system_names() const;

  private:
    struct State;

    SystemOrder& add_function(std::unique_ptr<System> system, FunctionKey key, SourceLine where);
    SystemOrder& add_system(std::string name, FunctionKey key, std::unique_ptr<System> system);

    std::unique_ptr<State> state_;
};

}  // namespace vellus
