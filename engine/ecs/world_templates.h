#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

#include "engine/ecs/query.h"
#include "engine/ecs/world.h"

// The bodies of World's templates.
namespace vellus {

template <class... Ts>
Table& World::bundle_table() {
    const uint32_t index = kTypeIndex<BundleFamily, Ts...>;
    if (index < bundles_.size() && bundles_[index] != nullptr) return *bundles_[index];
    Table& table = table_of({&kComponent<Ts>...});
    if (index >= bundles_.size()) bundles_.resize(index + 1, nullptr);
    bundles_[index] = &table;
    return table;
}

template <class... Ts>
Entity World::spawn(Ts... components) {
    check_unlocked("spawn");
    Table& table = bundle_table<Ts...>();
    const uint32_t row = append_row(table);
    (std::construct_at(table.column<Ts>() + row, std::move(components)), ...);
    return table.entity_data()[row];
}

template <class... Ts>
std::span<const Entity> World::spawn_many(size_t count) {
    return spawn_many<Ts...>(count, [](size_t, Ts&...) {});
}

template <class... Ts, class Fill>
std::span<const Entity> World::spawn_many(size_t count, Fill&& fill) {
    check_unlocked("spawn_many");
    const Lock lock(*this);
    Table& table = bundle_table<Ts...>();
    const uint32_t first = append_rows(table, count);
    [&](Ts* const... columns) {
        for (size_t i = 0; i < count; ++i) fill(i, *::new (columns + i) Ts()...);
    }(table.column<Ts>() + first...);
    return table.entities().subspan(first, count);
}

template <class T>
bool World::add(Entity entity, T component) {
    check_unlocked("add");
    Record* const record = find(entity);
    if (record == nullptr) return false;
    Table& from = current_table(*record);
    const Table::Neighbour* to = from.neighbour(kComponent<T>.id);
    if (to == nullptr || !to->adds) [[unlikely]] {
        if (T* const column = from.column<T>(); column != nullptr) {
            std::destroy_at(column + record->row);
            std::construct_at(column + record->row, std::move(component));
            return true;
        }
        to = find_neighbour(from, kComponent<T>);
    }
    const uint32_t row = move_row(entity, *record, from, *to);
    std::construct_at(reinterpret_cast<T*>(to->table->slot_data(to->slot)) + row,
                      std::move(component));
    return true;
}

template <class T>
bool World::remove(Entity entity) {
    check_unlocked("remove");
    Record* const record = find(entity);
    if (record == nullptr) return false;
    Table& from = current_table(*record);
    const Table::Neighbour* to = from.neighbour(kComponent<T>.id);
    if (to == nullptr || to->adds) [[unlikely]] {
        if (!from.has(kComponent<T>.id)) return false;
        to = find_neighbour(from, kComponent<T>);
    }
    move_row(entity, *record, from, *to);
    return true;
}

template <class T>
T* World::get(Entity entity) noexcept {
    const Record* const record = find(entity);
    if (record == nullptr) return nullptr;
    T* const column = record->table->column<T>();
    return column == nullptr ? nullptr : column + record->row;
}

template <class... Terms>
Query<Terms...> World::query() {
    const uint32_t index = kTypeIndex<QueryFamily, Terms...>;
    if (index < queries_.size() && queries_[index] != nullptr) return {*this, *queries_[index]};
    return {*this, register_query(index, Query<Terms...>::make_state())};
}

}  // namespace vellus
