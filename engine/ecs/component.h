#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/ecs/type_index.h"

namespace vellus {

using ComponentId = uint32_t;

/// What a table needs to know of a component's C++ type.
struct ComponentType {
    ComponentId id;
    std::string_view name;
    size_t size;
    size_t alignment;
    bool trivial;  ///< May be moved by memcpy and needs no destructor.
    /// Moves `count` objects into raw memory; the sources are raw memory afterwards.
    void (*relocate)(void* to, void* from, size_t count);
    void (*destroy)(void* first, size_t count);
    /// Takes the object at `hole` out of a column: into the raw memory `to`, or destroys it where
    /// `to` is null. Then the column's `last` object fills the hole.
    void (*take)(void* to, void* hole, void* last);
};

namespace detail {

template <class T>
void relocate(void* to, void* from, size_t count) {
    if constexpr (std::is_trivially_copyable_v<T>) {
        std::memcpy(to, from, count * sizeof(T));
    } else {
        std::uninitialized_move_n(static_cast<T*>(from), count, static_cast<T*>(to));
        std::destroy_n(static_cast<T*>(from), count);
    }
}

template <class T>
void destroy(void* first, size_t count) {
    std::destroy_n(static_cast<T*>(first), count);
}

template <class T>
void take(void* to, void* hole, void* last) {
    if (to != nullptr) {
        relocate<T>(to, hole, 1);
    } else {
        destroy<T>(hole, 1);
    }
    if (hole != last) relocate<T>(hole, last, 1);
}

template <class T>
ComponentType make_component_type() {
    static_assert(std::is_same_v<T, std::decay_t<T>> && !std::is_pointer_v<T>,
                  "a component is a plain value type");
    static_assert(std::is_nothrow_move_constructible_v<T> && std::is_nothrow_destructible_v<T>,
                  "a component must move and die without throwing: tables move their rows");
    return {next_type_index<ComponentFamily>(), type_name<T>(), sizeof(T),  alignof(T),
            std::is_trivially_copyable_v<T>,    relocate<T>,    destroy<T>, take<T>};
}

}  // namespace detail

template <class T>
inline const ComponentType kComponent = detail::make_component_type<T>();

}  // namespace vellus
