#include "engine/ecs/query_state.h"

#include <algorithm>
#include <numeric>

namespace vellus {

bool QueryState::matches(const Table& table) const noexcept {
    const auto in_table = [&](ComponentId id) { return table.has(id); };
    return std::all_of(required_.begin(), required_.end(), in_table) &&
           std::none_of(excluded_.begin(), excluded_.end(), in_table);
}

void QueryState::consider(Table& table) {
    if (matches(table)) tables_.push_back(&table);
}

size_t QueryState::count() const noexcept {
    return std::accumulate(tables_.begin(), tables_.end(), size_t{0},
                           [](size_t sum, const Table* table) { return sum + table->size(); });
}

}  // namespace vellus
