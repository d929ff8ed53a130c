#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/component.h"
#include "engine/ecs/entity.h"

namespace vellus {

/// All entities with the same set of components: one contiguous column per component, plus the
/// entities themselves; row i of every column belongs to the same entity. Rows are dense: the last
/// row fills a removed one.
class Table {
  public:
    /// A table that has one component more, or less, than another; `slot` is that component's
    /// column in the larger one.
    struct Neighbour {
        Table* table = nullptr;
        uint32_t slot = 0;
        bool adds = false;  ///< This is the larger one.
    };

    /// `types` sorted by id, without duplicates.
    explicit Table(std::vector<const ComponentType*> types);
    ~Table();
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    [[nodiscard]] uint32_t size() const noexcept { return size_; }
    [[nodiscard]] std::span<const ComponentType* const> types() const noexcept { return types_; }
    [[nodiscard]] std::span<const Entity> entities() const noexcept { return {entities_, size_}; }
    [[nodiscard]] Entity* entity_data() noexcept { return entities_; }

    /// First object of the component's column; null where this table has no such column.
    [[nodiscard]] std::byte* data(ComponentId id) const noexcept {
        return id < data_.size() ? data_[id] : nullptr;
    }
    [[nodiscard]] bool has(ComponentId id) const noexcept { return data(id) != nullptr; }
    template <class T>
    [[nodiscard]] T* column() const noexcept {
        return reinterpret_cast<T*>(data(kComponent<T>.id));
    }

    [[nodiscard]] std::byte* slot_data(uint32_t slot) const noexcept { return columns_[slot].data; }

    /// Has space for so many more rows: at least doubles it where it grows.
    void make_room(size_t rows) {
        if (rows > capacity_ - size_) grow(size_ + rows);
    }
    /// Adds rows whose components the caller must construct, and whose entities it must set.
    uint32_t append(size_t count) {
        make_room(count);
        const uint32_t first = size_;
        size_ += static_cast<uint32_t>(count);
        return first;
    }
    /// Destroys a row's components. The last row fills the gap; returns its entity, which is the
    /// erased one itself where that was the last.
    Entity erase(uint32_t row);
    /// Moves the row's components to a new row of the other table; destroys the one it lacks and
    /// leaves raw memory for the one it adds. The last row fills the gap, as in erase.
    Entity take_row(uint32_t row, const Neighbour& to, uint32_t to_row);

    /// What lies behind adding (or, where this has it, removing) the component; null until set.
    /// Lasts until the next set_neighbour.
    [[nodiscard]] const Neighbour* neighbour(ComponentId id) const noexcept {
        if (id >= neighbours_.size() || neighbours_[id].table == nullptr) return nullptr;
        return &neighbours_[id];
    }
    /// Returns where it keeps the neighbour.
    const Neighbour* set_neighbour(ComponentId id, Neighbour neighbour);

  private:
    struct Column {
        std::byte* data;
        MoveRow* move;  // of the type, kept here as they are called for each row that moves
        EraseRow* erase;
        const ComponentType* type;
    };

    void grow(size_t rows);
    void set_capacity(uint32_t rows);

    uint32_t size_ = 0;
    uint32_t capacity_ = 0;
    Entity* entities_ = nullptr;
    std::vector<Column> columns_;
    std::vector<std::byte*> data_;  // the columns' data by component id
    std::vector<const ComponentType*> types_;
    std::vector<Neighbour> neighbours_;  // by component id
};

}  // namespace vellus
