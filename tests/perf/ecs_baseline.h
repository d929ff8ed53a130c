#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

namespace vellus::bench {

struct Position {
    float x, y, z;
};
struct Velocity {
    float x, y, z;
};
struct Health {
    int32_t points;
};
struct Mass {
    float kilograms;
};

/// What one writes by hand without an ECS: a vector per component, and an index from handles to
/// rows. It knows its archetypes at compile time, which is the advantage to be measured against.
struct HandHandle {
    uint32_t index;
    uint32_t generation;
};

template <class... Ts>
struct HandTable {
    std::vector<HandHandle> handles;
    std::tuple<std::vector<Ts>...> columns;

    template <class T>
    std::vector<T>& column() {
        return std::get<std::vector<T>>(columns);
    }
    uint32_t push(HandHandle handle, const Ts&... values) {
        handles.push_back(handle);
        (column<Ts>().push_back(values), ...);
        return static_cast<uint32_t>(handles.size() - 1);
    }
    void resize(size_t size) {
        handles.resize(size);
        (column<Ts>().resize(size), ...);
    }
    /// Fills the row with the last one, whose handle is returned.
    HandHandle swap_pop(uint32_t row) {
        const HandHandle moved = handles.back();
        handles[row] = moved;
        handles.pop_back();
        ((column<Ts>()[row] = column<Ts>().back(), column<Ts>().pop_back()), ...);
        return moved;
    }
};

/// Entities with some components `Ts`, that may gain and lose an Extra.
template <class Extra, class... Ts>
struct HandWorld {
    struct Slot {
        uint32_t row;
        uint32_t generation;
        bool extended;
    };
    std::vector<Slot> slots;
    std::vector<uint32_t> free_slots;
    HandTable<Ts...> plain;
    HandTable<Ts..., Extra> extended;

    bool alive(HandHandle handle) const {
        return handle.index < slots.size() && slots[handle.index].generation == handle.generation;
    }

    HandHandle create(const Ts&... values) {
        HandHandle handle{static_cast<uint32_t>(slots.size()), 0};
        if (free_slots.empty()) {
            slots.push_back({});
        } else {
            handle.index = free_slots.back();
            handle.generation = slots[handle.index].generation;
            free_slots.pop_back();
        }
        slots[handle.index] = {plain.push(handle, values...), handle.generation, false};
        return handle;
    }

    /// For an empty world.
    template <class Fill>
    void create_many(uint32_t count, const Fill& fill) {
        slots.resize(count);
        plain.resize(count);
        for (uint32_t i = 0; i < count; ++i) {
            slots[i] = {i, 0, false};
            plain.handles[i] = {i, 0};
            fill(i, plain.template column<Ts>()[i]...);
        }
    }

    void add(HandHandle handle, const Extra& extra) {
        if (!alive(handle)) return;
        Slot& slot = slots[handle.index];
        if (slot.extended) {
            extended.template column<Extra>()[slot.row] = extra;
            return;
        }
        const uint32_t old_row = slot.row;
        slot.row = extended.push(handle, plain.template column<Ts>()[old_row]..., extra);
        slot.extended = true;
        const HandHandle moved = plain.swap_pop(old_row);
        if (moved.index != handle.index) slots[moved.index].row = old_row;
    }

    void remove(HandHandle handle) {
        if (!alive(handle) || !slots[handle.index].extended) return;
        Slot& slot = slots[handle.index];
        const uint32_t old_row = slot.row;
        slot.row = plain.push(handle, extended.template column<Ts>()[old_row]...);
        slot.extended = false;
        const HandHandle moved = extended.swap_pop(old_row);
        if (moved.index != handle.index) slots[moved.index].row = old_row;
    }

    void destroy(HandHandle handle) {
        if (!alive(handle)) return;
        Slot& slot = slots[handle.index];
        const HandHandle moved =
            slot.extended ? extended.swap_pop(slot.row) : plain.swap_pop(slot.row);
        if (moved.index != handle.index) slots[moved.index].row = slot.row;
        ++slot.generation;
        free_slots.push_back(handle.index);
    }

    template <class T>
    T* get(HandHandle handle) {
        if (!alive(handle)) return nullptr;
        const Slot& slot = slots[handle.index];
        return slot.extended ? &extended.template column<T>()[slot.row]
                             : &plain.template column<T>()[slot.row];
    }
};

}  // namespace vellus::bench
