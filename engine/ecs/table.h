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
/// row fills a removed one. Columns of trivial types grow by realloc, which remaps large blocks
/// instead of copying them (README, "Why contiguous").
class Table {
  public:
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

    void reserve(size_t rows);
    /// Adds rows whose components the caller must construct, and whose entities it must set.
    uint32_t append(uint32_t count) {
        if (count > capacity_ - size_) grow(size_t{size_} + count);
        const uint32_t first = size_;
        size_ += count;
        return first;
    }
    /// Destroys a row's components; the last row fills the gap.
    void erase(uint32_t row);
    /// Moves the row's components that `to` has into `to`'s `to_row`; drops the others.
    void take_row(uint32_t row, Table& to, uint32_t to_row);

    /// The table with `id` added (or removed, where this one has it); null until first needed.
    [[nodiscard]] Table* neighbour(ComponentId id) const noexcept {
        return id < neighbours_.size() ? neighbours_[id] : nullptr;
    }
    void set_neighbour(ComponentId id, Table& table);

  private:
    void grow(size_t rows);
    void set_capacity(uint32_t rows);

    uint32_t size_ = 0;
    uint32_t capacity_ = 0;
    Entity* entities_ = nullptr;
    std::vector<std::byte*> data_;  // by component id
    std::vector<const ComponentType*> types_;
    std::vector<Table*> neighbours_;  // by component id
};

}  // namespace vellus
