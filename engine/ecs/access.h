#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/ecs/query_terms.h"

namespace vellus {

/// One component or resource that a system touches.
struct TypeAccess {
    uint32_t id;
    std::string_view name;
    bool writes;
};

/// What one query touches, and the filters that may prove it disjoint from another.
struct QueryAccess {
    std::vector<TypeAccess> components;
    std::vector<ComponentId> required;
    std::vector<ComponentId> excluded;
};

/// All that a system touches, derived from its parameters.
struct Access {
    std::vector<QueryAccess> queries;
    std::vector<TypeAccess> resources;
    bool commands = false;
    bool exclusive = false;  ///< Takes the World itself.
};

struct AccessConflict {
    std::string_view kind;  ///< "component", "resource" or "world"
    std::string_view name;
    bool first_writes;
    bool second_writes;
};

/// The first thing that one of the two writes and the other touches; empty where they may run at
/// the same time. Queries that can match no common entity do not conflict.
std::optional<AccessConflict> find_conflict(const Access& first, const Access& second);

template <class... Terms>
QueryAccess query_access() {
    QueryAccess access;
    const auto sort_in = [&]<class Term>(std::type_identity<Term>) {
        using T = typename QueryTerm<Term>::Component;
        if constexpr (!std::is_void_v<T>) {
            const ComponentType& type = kComponent<T>;
            if constexpr (QueryTerm<Term>::kYields) {
                access.components.push_back({type.id, type.name, QueryTerm<Term>::kWrites});
            }
            if (QueryTerm<Term>::kPresence == Presence::kRequired)
                access.required.push_back(type.id);
            if (QueryTerm<Term>::kPresence == Presence::kExcluded)
                access.excluded.push_back(type.id);
        }
    };
    (sort_in(std::type_identity<Terms>{}), ...);
    return access;
}

}  // namespace vellus
