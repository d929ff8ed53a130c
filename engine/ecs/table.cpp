#include "engine/ecs/table.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "engine/ecs/contract.h"
#include "engine/ecs/memory.h"

namespace vellus {
namespace {

constexpr uint32_t kFirstCapacity = 8;

bool grows_in_place(const ComponentType& type) {
    return type.trivial && type.alignment <= alignof(std::max_align_t);
}

std::byte* resized_column(const ComponentType& type, std::byte* old, size_t size,
                          size_t old_capacity, size_t capacity) {
    if (grows_in_place(type)) {
        return static_cast<std::byte*>(
            resize_memory(old, old_capacity * type.size, capacity * type.size));
    }
    const size_t alignment = std::max(type.alignment, alignof(std::max_align_t));
    const size_t bytes = (capacity * type.size + alignment - 1) / alignment * alignment;
    auto* const fresh = static_cast<std::byte*>(std::aligned_alloc(alignment, bytes));
    if (fresh == nullptr) contract_failed("ecs: out of memory for a component column");
    if (size > 0) type.relocate(fresh, old, size);
    std::free(old);
    return fresh;
}

void free_column(const ComponentType& type, std::byte* data, size_t capacity) {
    if (grows_in_place(type)) {
        resize_memory(data, capacity * type.size, 0);
    } else {
        std::free(data);
    }
}

}  // namespace

Table::Table(std::vector<const ComponentType*> types)
    : data_(types.empty() ? 0 : types.back()->id + 1, nullptr), types_(std::move(types)) {
    for (const ComponentType* type : types_) {
        columns_.push_back({nullptr, type->move, type->erase, type});
    }
    set_capacity(kFirstCapacity);
}

Table::~Table() {
    for (const Column& column : columns_) {
        column.type->destroy(column.data, size_);
        free_column(*column.type, column.data, capacity_);
    }
    resize_memory(entities_, capacity_ * sizeof(Entity), 0);
}

void Table::grow(size_t rows) {
    if (rows > UINT32_MAX) contract_failed("ecs: a table holds at most 2^32 - 1 entities");
    const size_t doubled = std::min<size_t>(size_t{capacity_} * 2, UINT32_MAX);
    set_capacity(static_cast<uint32_t>(std::max(rows, doubled)));
}

void Table::set_capacity(uint32_t rows) {
    for (Column& column : columns_) {
        column.data = resized_column(*column.type, column.data, size_, capacity_, rows);
        data_[column.type->id] = column.data;
    }
    entities_ = static_cast<Entity*>(
        resize_memory(entities_, capacity_ * sizeof(Entity), rows * sizeof(Entity)));
    capacity_ = rows;
}

Entity Table::erase(uint32_t row) {
    const size_t last = --size_;
    for (const Column& column : columns_) column.erase(column.data, row, last);
    return entities_[row] = entities_[last];
}

Entity Table::take_row(uint32_t row, const Neighbour& to, uint32_t to_row) {
    const size_t last = --size_;
    const Column* from = columns_.data();
    const Column* const end = from + columns_.size();
    const Column* target = to.table->columns_.data();
    for (const Column* split = from + to.slot; from != split; ++from, ++target) {
        from->move(from->data, row, last, target->data, to_row);
    }
    if (to.adds) {
        ++target;
    } else {
        from->erase(from->data, row, last);
        ++from;
    }
    for (; from != end; ++from, ++target) {
        from->move(from->data, row, last, target->data, to_row);
    }
    return entities_[row] = entities_[last];
}

const Table::Neighbour* Table::set_neighbour(ComponentId id, Neighbour neighbour) {
    if (neighbours_.size() <= id) neighbours_.resize(id + 1);
    neighbours_[id] = neighbour;
    return &neighbours_[id];
}

}  // namespace vellus
