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

/// Moves an object to raw memory in another column; the column's last object fills the gap.
using MoveRow = void(void* column, size_t row, size_t last, void* to_column, size_t to_row);
/// Destroys an object; the column's last object fills the gap.
using EraseRow = void(void* column, size_t row, size_t last);

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
    MoveRow* move;
    EraseRow* erase;
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
inline void fill_gap(T* column, size_t row, size_t last) {
    // A small object copied onto itself is cheaper than a test.
    constexpr bool kCopyAnyway = std::is_trivially_copyable_v<T> && sizeof(T) <= 64;
    if constexpr (kCopyAnyway) {
        std::byte object[sizeof(T)];
        std::memcpy(object, column + last, sizeof(T));
        std::memcpy(static_cast<void*>(column + row), object, sizeof(T));
    } else if (row != last) {
        relocate<T>(column + row, column + last, 1);
    }
}

template <class T>
void move_row(void* column, size_t row, size_t last, void* to_column, size_t to_row) {
    relocate<T>(static_cast<T*>(to_column) + to_row, static_cast<T*>(column) + row, 1);
    fill_gap(static_cast<T*>(column), row, last);
}

template <class T>
void erase_row(void* column, size_t row, size_t last) {
    std::destroy_at(static_cast<T*>(column) + row);
    fill_gap(static_cast<T*>(column), row, last);
}

template <class T>
ComponentType make_component_type() {
    static_assert(std::is_same_v<T, std::decay_t<T>> && !std::is_pointer_v<T>,
                  "a component is a plain value type");
    static_assert(std::is_nothrow_move_constructible_v<T> && std::is_nothrow_destructible_v<T>,
                  "a component must move and die without throwing: tables move their rows");
    return {next_type_index<ComponentFamily>(),
            type_name<T>(),
            sizeof(T),
            alignof(T),
            std::is_trivially_copyable_v<T>,
            relocate<T>,
            destroy<T>,
            move_row<T>,
            erase_row<T>};
}

}  // namespace detail

template <class T>
inline const ComponentType kComponent = detail::make_component_type<T>();

}  // namespace vellus
