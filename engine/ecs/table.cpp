#include "engine/ecs/table.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "engine/ecs/contract.h"

namespace vellus {
namespace {

constexpr uint32_t kFirstCapacity = 8;

std::byte* checked(void* memory) {
    if (memory == nullptr) contract_failed("ecs: out of memory for a component column");
    return static_cast<std::byte*>(memory);
}

std::byte* resized_column(const ComponentType& type, std::byte* old, size_t size, size_t capacity) {
    const size_t bytes = capacity * type.size;
    if (type.trivial && type.alignment <= alignof(std::max_align_t)) {
        return checked(std::realloc(old, bytes));
    }
    const size_t alignment = std::max(type.alignment, alignof(std::max_align_t));
    const size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    std::byte* fresh = checked(std::aligned_alloc(alignment, rounded));
    if (size > 0) type.relocate(fresh, old, size);
    std::free(old);
    return fresh;
}

}  // namespace

Table::Table(std::vector<const ComponentType*> types)
    : data_(types.empty() ? 0 : types.back()->id + 1, nullptr), types_(std::move(types)) {
    set_capacity(kFirstCapacity);
}

Table::~Table() {
    for (const ComponentType* type : types_) {
        type->destroy(data_[type->id], size_);
        std::free(data_[type->id]);
    }
    std::free(entities_);
}

void Table::reserve(size_t rows) {
    if (rows > UINT32_MAX) contract_failed("ecs: a table holds at most 2^32 - 1 entities");
    if (rows > capacity_) set_capacity(static_cast<uint32_t>(rows));
}

void Table::grow(size_t rows) {
    reserve(std::max(rows, std::min<size_t>(size_t{capacity_} * 2, UINT32_MAX)));
}

void Table::set_capacity(uint32_t rows) {
    for (const ComponentType* type : types_) {
        data_[type->id] = resized_column(*type, data_[type->id], size_, rows);
    }
    entities_ = reinterpret_cast<Entity*>(checked(std::realloc(entities_, rows * sizeof(Entity))));
    capacity_ = rows;
}

void Table::erase(uint32_t row) {
    const size_t last = --size_;
    for (const ComponentType* type : types_) {
        std::byte* column = data_[type->id];
        type->take(nullptr, column + row * type->size, column + last * type->size);
    }
    entities_[row] = entities_[last];
}

void Table::take_row(uint32_t row, Table& to, uint32_t to_row) {
    const size_t last = --size_;
    for (const ComponentType* type : types_) {
        std::byte* column = data_[type->id];
        std::byte* target = to.data(type->id);
        type->take(target == nullptr ? nullptr : target + to_row * type->size,
                   column + row * type->size, column + last * type->size);
    }
    to.entities_[to_row] = entities_[row];
    entities_[row] = entities_[last];
}

void Table::set_neighbour(ComponentId id, Table& table) {
    if (neighbours_.size() <= id) neighbours_.resize(id + 1, nullptr);
    neighbours_[id] = &table;
}

}  // namespace vellus
