#include "engine/ecs/access.h"

#include <algorithm>

namespace vellus {
namespace {

bool contains_any(const std::vector<ComponentId>& set, const std::vector<ComponentId>& of) {
    return std::find_first_of(set.begin(), set.end(), of.begin(), of.end()) != set.end();
}

bool disjoint(const QueryAccess& a, const QueryAccess& b) {
    return contains_any(a.required, b.excluded) || contains_any(b.required, a.excluded);
}

std::optional<AccessConflict> find_in(std::string_view kind, const std::vector<TypeAccess>& first,
                                      const std::vector<TypeAccess>& second) {
    for (const TypeAccess& a : first) {
        for (const TypeAccess& b : second) {
            if (a.id == b.id && (a.writes || b.writes)) {
                return AccessConflict{kind, a.name, a.writes, b.writes};
            }
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<AccessConflict> find_conflict(const Access& first, const Access& second) {
    if (first.exclusive || second.exclusive) {
        return AccessConflict{"world", "World", first.exclusive, second.exclusive};
    }
    for (const QueryAccess& a : first.queries) {
        for (const QueryAccess& b : second.queries) {
            if (disjoint(a, b)) continue;
            if (auto conflict = find_in("component", a.components, b.components)) return conflict;
        }
    }
    return find_in("resource", first.resources, second.resources);
}

}  // namespace vellus
