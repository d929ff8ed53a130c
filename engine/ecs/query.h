#pragma once

#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "engine/ecs/access.h"
#include "engine/ecs/query_state.h"
#include "engine/ecs/query_terms.h"
#include "engine/ecs/world.h"
#include "engine/platform/jobs.h"

namespace vellus {

/// Entities that match all terms: `T` (read and write), `const T` (read), `T*`, `const T*` (null
/// where absent), `Entity`, `With<T>`, `Without<T>`. A cheap handle to matches the world caches.
template <class... Terms>
class Query {
    using Yielded = detail::YieldedTerms<Terms...>;
    template <class Tuple>
    struct ValuesOf;
    template <class... Ts>
    struct ValuesOf<std::tuple<Ts...>> {
        using Type = std::tuple<typename Ts::Value...>;
    };

  public:
    using Values = typename ValuesOf<Yielded>::Type;

    Query(World& world, const QueryState& state) noexcept : world_(&world), state_(&state) {}

    /// Calls `visit(values...)` or `visit(Entity, values...)` for each entity.
    template <class Visit>
    void each(Visit&& visit) const {
        const World::Lock lock(*world_);
        for (const Table* table : state_->tables()) visit_rows(*table, 0, table->size(), visit);
    }

    /// The same on all cores, in ranges of `grain` rows; `visit` must be safe to call concurrently.
    template <class Visit>
    void parallel_each(Visit&& visit, size_t grain = 4096) const {
        const World::Lock lock(*world_);
        for (const Table* table : state_->tables()) {
            parallel_ranges(table->size(), grain, [&](size_t first, size_t last) {
                visit_rows(*table, first, last, visit);
            });
        }
    }

    /// Calls `visit(spans...)` or `visit(std::span<const Entity>, spans...)` for each table that
    /// has rows. An absent optional component yields an empty span.
    template <class Visit>
    void each_chunk(Visit&& visit) const {
        const World::Lock lock(*world_);
        for (const Table* table : state_->tables()) {
            if (table->size() == 0) continue;
            with_terms(*table, [&](const auto&... terms) {
                if constexpr (std::is_invocable_v<Visit&, decltype(terms.all(0))...>) {
                    visit(terms.all(table->size())...);
                } else {
                    visit(table->entities(), terms.all(table->size())...);
                }
            });
        }
    }

    /// What `each` would pass for this entity; empty where it is dead or does not match.
    [[nodiscard]] std::optional<Values> get(Entity entity) const {
        const World::Record* const record = std::as_const(*world_).find(entity);
        if (record == nullptr || !state_->matches(*record->table)) return std::nullopt;
        return with_terms(*record->table, [&](const auto&... terms) {
            return std::optional<Values>(std::in_place, terms.at(record->row)...);
        });
    }

    [[nodiscard]] size_t count() const noexcept { return state_->count(); }
    [[nodiscard]] bool empty() const noexcept { return count() == 0; }

    static QueryState make_state();

  private:
    template <class Visit>
    static decltype(auto) with_terms(const Table& table, const Visit& visit) {
        return [&]<class... Ts>(std::type_identity<std::tuple<Ts...>>) {
            return visit(Ts(table)...);
        }(std::type_identity<Yielded>{});
    }

    template <class Visit>
    static void visit_rows(const Table& table, size_t first, size_t last, Visit& visit) {
        // Terms by value: the loop then keeps the column pointers in registers.
        with_terms(table, [&](auto... terms) {
            if constexpr (std::is_invocable_v<Visit&, decltype(terms.at(0))...>) {
                for (size_t row = first; row < last; ++row) visit(terms.at(row)...);
            } else {
                const Entity* const entities = table.entities().data();
                for (size_t row = first; row < last; ++row) {
                    visit(entities[row], terms.at(row)...);
                }
            }
        });
    }

    World* world_;
    const QueryState* state_;
};

template <class... Terms>
QueryState Query<Terms...>::make_state() {
    QueryAccess access = query_access<Terms...>();
    return {std::move(access.required), std::move(access.excluded)};
}

}  // namespace vellus
