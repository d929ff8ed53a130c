#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>

#include "engine/ecs/component.h"
#include "engine/ecs/entity.h"
#include "engine/ecs/table.h"

namespace vellus {

/// Query filters: only entities that have (have not) a T, whose value is not touched.
template <class T>
struct With {};
template <class T>
struct Without {};

enum class Presence : uint8_t { kRequired, kOptional, kExcluded };

/// What a query term asks of a table and what it yields there: T& and const T& for T and const T,
/// a pointer (null where absent) for T* and const T*, an Entity for Entity, nothing for filters.
template <class Term>
struct QueryTerm {
    using Component = std::remove_const_t<Term>;
    static constexpr Presence kPresence = Presence::kRequired;
    static constexpr bool kYields = true;
    static constexpr bool kWrites = !std::is_const_v<Term>;

    using Value = Term&;
    Term* base;
    explicit QueryTerm(const Table& table) noexcept : base(table.column<Component>()) {}
    Value at(size_t row) const noexcept { return base[row]; }
    std::span<Term> all(size_t count) const noexcept { return {base, count}; }
};

template <class Term>
struct QueryTerm<Term*> {
    using Component = std::remove_const_t<Term>;
    static constexpr Presence kPresence = Presence::kOptional;
    static constexpr bool kYields = true;
    static constexpr bool kWrites = !std::is_const_v<Term>;

    using Value = Term*;
    Term* base;
    explicit QueryTerm(const Table& table) noexcept : base(table.column<Component>()) {}
    Value at(size_t row) const noexcept { return base == nullptr ? nullptr : base + row; }
    std::span<Term> all(size_t count) const noexcept { return {base, base == nullptr ? 0 : count}; }
};

template <>
struct QueryTerm<Entity> {
    using Component = void;
    static constexpr bool kYields = true;

    using Value = Entity;
    const Entity* base;
    explicit QueryTerm(const Table& table) noexcept : base(table.entities().data()) {}
    Value at(size_t row) const noexcept { return base[row]; }
    std::span<const Entity> all(size_t count) const noexcept { return {base, count}; }
};

template <class T>
struct QueryTerm<With<T>> {
    using Component = T;
    static constexpr Presence kPresence = Presence::kRequired;
    static constexpr bool kYields = false;
    static constexpr bool kWrites = false;
};

template <class T>
struct QueryTerm<Without<T>> {
    using Component = T;
    static constexpr Presence kPresence = Presence::kExcluded;
    static constexpr bool kYields = false;
    static constexpr bool kWrites = false;
};

namespace detail {

template <class Term>
using YieldedTerm =
    std::conditional_t<QueryTerm<Term>::kYields, std::tuple<QueryTerm<Term>>, std::tuple<>>;

/// The terms that yield a value, as a tuple.
template <class... Terms>
using YieldedTerms = decltype(std::tuple_cat(std::declval<YieldedTerm<Terms>>()...));

}  // namespace detail
}  // namespace vellus
