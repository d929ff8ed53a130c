#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/ecs/component.h"
#include "engine/ecs/entity.h"
#include "engine/ecs/growing_array.h"
#include "engine/ecs/resources.h"
#include "engine/ecs/table.h"

namespace vellus {

class QueryState;
template <class... Terms>
class Query;

/// Entities with their components, and resources (one value per type). Structural changes (spawn,
/// add, remove, destroy) invalidate component pointers and are refused, with an abort, while a
/// query iterates or systems run: record those in Commands.
class World : public Resources {
  public:
    World();
    ~World();

    /// Makes an entity with these components.
    template <class... Ts>
    Entity spawn(Ts... components);

    /// Makes `count` entities, value-initialised; the span lasts until the next structural change.
    template <class... Ts>
    std::span<const Entity> spawn_many(size_t count);
    /// The same, then calls `fill(i, Ts&...)` for each, i from 0.
    template <class... Ts, class Fill>
    std::span<const Entity> spawn_many(size_t count, Fill&& fill);

    /// Adds the component, or replaces its value; false where the entity is not alive.
    template <class T>
    bool add(Entity entity, T component);
    /// False where the entity is not alive or has no such component.
    template <class T>
    bool remove(Entity entity);
    /// False where the entity is not alive.
    bool destroy(Entity entity);

    [[nodiscard]] bool alive(Entity entity) const noexcept { return find(entity) != nullptr; }
    /// Null where the entity is not alive or has no such component.
    template <class T>
    [[nodiscard]] T* get(Entity entity) noexcept;
    template <class T>
    [[nodiscard]] const T* get(Entity entity) const noexcept {
        return const_cast<World*>(this)->get<T>(entity);
    }
    template <class T>
    [[nodiscard]] bool has(Entity entity) const noexcept {
        return get<T>(entity) != nullptr;
    }
    [[nodiscard]] size_t entity_count() const noexcept { return alive_count_; }

    /// The cached query of these terms (query.h); the first call per type registers it.
    template <class... Terms>
    [[nodiscard]] Query<Terms...> query();

    /// While one lives, structural changes abort. Queries and schedules hold it.
    class Lock {
      public:
        explicit Lock(World& world) noexcept : world_(world) { ++world_.locks_; }
        ~Lock() { --world_.locks_; }
        Lock(const Lock&) = delete;
        Lock& operator=(const Lock&) = delete;

      private:
        World& world_;
    };

  private:
    template <class... Terms>
    friend class Query;
    friend struct WorldTestAccess;

    /// Where a live entity is; for a free slot `table` is null and `row` the next free slot.
    struct Record {
        Table* table;
        uint32_t row;
        uint32_t generation;
    };
    struct TypesHash {
        size_t operator()(const std::vector<const ComponentType*>& types) const noexcept;
    };

    /// The record's table. Where it is the table of the previous call, as in most loops, a branch
    /// predicts so: the processor then works on before the record has come from memory.
    [[nodiscard]] Table& current_table(const Record& record) noexcept {
        Table* guess = last_table_;
        asm("" : "+r"(guess));  // hides that guess equals record.table where the test below holds
        if (record.table != last_table_) [[unlikely]]
            guess = last_table_ = record.table;
        return *guess;
    }

    [[nodiscard]] const Record* find(Entity entity) const noexcept {
        if (entity.index >= records_.size()) return nullptr;
        const Record& record = records_[entity.index];
        return record.generation == entity.generation ? &record : nullptr;
    }
    [[nodiscard]] Record* find(Entity entity) noexcept {
        return const_cast<Record*>(std::as_const(*this).find(entity));
    }

    void check_unlocked(const char* operation) const {
        if (locks_.load(std::memory_order_relaxed) != 0) refuse(operation);
    }
    [[noreturn]] static void refuse(const char* operation);

    template <class... Ts>
    Table& bundle_table();
    Table& table_of(std::vector<const ComponentType*> types);
    const Table::Neighbour* find_neighbour(Table& table, const ComponentType& type);
    QueryState& register_query(uint32_t index, QueryState state);

    uint32_t append_slots(size_t count);
    uint32_t append_row(Table& table);
    uint32_t append_rows(Table& table, size_t count);
    uint32_t move_row(Entity entity, Record& record, Table& from, const Table::Neighbour& to) {
        const uint32_t old_row = record.row;
        const uint32_t row = to.table->append(1);
        to.table->entity_data()[row] = entity;
        records_[from.take_row(old_row, to, row).index].row = old_row;
        record.table = to.table;
        record.row = row;
        return row;
    }

    GrowingArray<Record> records_;
    uint32_t first_free_ = UINT32_MAX;
    Table* last_table_ = nullptr;  // a guess, see current_table
    size_t alive_count_ = 0;
    std::atomic<uint32_t> locks_{0};
    std::vector<std::unique_ptr<Table>> tables_;
    std::unordered_map<std::vector<const ComponentType*>, Table*, TypesHash> table_by_types_;
    std::vector<Table*> bundles_;                       // by bundle index
    std::vector<std::unique_ptr<QueryState>> queries_;  // by query index
};

}  // namespace vellus

#include "engine/ecs/world_templates.h"  // IWYU pragma: export
