#include "engine/ecs/world.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/ecs/contract.h"

namespace vellus {
namespace {

constexpr uint32_t kNoSlot = UINT32_MAX;
constexpr uint32_t kRetired = UINT32_MAX;  // a generation no entity ever gets

}  // namespace

World::World() = default;
World::~World() = default;

size_t World::TypesHash::operator()(const std::vector<const ComponentType*>& types) const noexcept {
    size_t hash = 14695981039346656037ULL;
    for (const ComponentType* type : types) hash = (hash ^ type->id) * 1099511628211ULL;
    return hash;
}

void World::refuse(const char* operation) {
    contract_failed(fmt::format(
        "ecs: World::{} while a query iterates or systems run; use Commands", operation));
}

Table& World::table_of(std::vector<const ComponentType*> types) {
    std::sort(types.begin(), types.end(),
              [](const ComponentType* a, const ComponentType* b) { return a->id < b->id; });
    if (std::adjacent_find(types.begin(), types.end()) != types.end()) {
        contract_failed("ecs: an entity has one component of each type");
    }
    Table*& table = table_by_types_[types];
    if (table != nullptr) return *table;
    table = tables_.emplace_back(std::make_unique<Table>(std::move(types))).get();
    for (const auto& query : queries_) {
        if (query != nullptr) query->consider(*table);
    }
    return *table;
}

const Table::Neighbour* World::find_neighbour(Table& table, const ComponentType& type) {
    std::vector<const ComponentType*> types(table.types().begin(), table.types().end());
    const bool adds = std::erase(types, &type) == 0;
    if (adds) types.push_back(&type);
    Table& other = table_of(std::move(types));
    const auto all = (adds ? other : table).types();
    const auto slot = static_cast<uint32_t>(std::ranges::find(all, &type) - all.begin());
    other.set_neighbour(type.id, {&table, slot, !adds});
    return table.set_neighbour(type.id, {&other, slot, adds});
}

QueryState& World::register_query(uint32_t index, QueryState state) {
    check_unlocked("query, for the first time,");
    if (index >= queries_.size()) queries_.resize(index + 1);
    queries_[index] = std::make_unique<QueryState>(std::move(state));
    for (const auto& table : tables_) queries_[index]->consider(*table);
    return *queries_[index];
}

uint32_t World::append_row(Table& table) {
    const uint32_t row = table.append(1);
    uint32_t index = first_free_;
    uint32_t generation = 1;
    if (index == kNoSlot) {
        index = append_slots(1);
    } else {
        first_free_ = records_[index].row;
        generation = records_[index].generation;
    }
    records_[index] = {&table, row, generation};
    table.entity_data()[row] = {index, generation};
    ++alive_count_;
    return row;
}

uint32_t World::append_slots(size_t count) {
    if (records_.size() + count > kNoSlot) {
        contract_failed("ecs: all 2^32 - 1 entity slots are in use");
    }
    return static_cast<uint32_t>(records_.append(count));
}

uint32_t World::append_rows(Table& table, size_t count) {
    table.make_room(count);
    const uint32_t first = table.size();
    while (count > 0 && first_free_ != kNoSlot) {
        append_row(table);
        --count;
    }
    uint32_t index = append_slots(count);
    uint32_t row = table.append(count);
    for (const uint32_t end = table.size(); row < end; ++row, ++index) {
        records_[index] = {&table, row, 1};
        table.entity_data()[row] = {index, 1};
    }
    alive_count_ += count;
    return first;
}

bool World::destroy(Entity entity) {
    check_unlocked("destroy");
    Record* const record = find(entity);
    if (record == nullptr) return false;
    Table& table = current_table(*record);
    const uint32_t row = record->row;
    records_[table.erase(row).index].row = row;
    record->table = nullptr;
    ++record->generation;
    if (record->generation != kRetired) {
        record->row = first_free_;
        first_free_ = entity.index;
    }
    --alive_count_;
    return true;
}

}  // namespace vellus
