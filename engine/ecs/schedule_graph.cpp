#include "engine/ecs/schedule_graph.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace vellus {
namespace {

/// Systems without a path between them, found by bit sets of all that comes after each.
class Reachability {
  public:
    Reachability(const ScheduleGraph& graph, const std::vector<uint32_t>& order)
        : after_(order.size(), std::vector<bool>(order.size())) {
        for (auto system = order.rbegin(); system != order.rend(); ++system) {
            for (const uint32_t next : graph.successors[*system]) {
                after_[*system][next] = true;
                for (size_t i = 0; i < order.size(); ++i) {
                    if (after_[next][i]) after_[*system][i] = true;
                }
            }
        }
    }
    [[nodiscard]] bool ordered(uint32_t a, uint32_t b) const {
        return after_[a][b] || after_[b][a];
    }

  private:
    std::vector<std::vector<bool>> after_;
};

std::vector<uint32_t> predecessor_counts(const ScheduleGraph& graph) {
    std::vector<uint32_t> counts(graph.names.size(), 0);
    for (const auto& successors : graph.successors) {
        for (const uint32_t next : successors) ++counts[next];
    }
    return counts;
}

/// Kahn's algorithm, earliest added first. Shorter than the graph where there is a cycle.
std::vector<uint32_t> topological_order(const ScheduleGraph& graph) {
    std::vector<uint32_t> counts = predecessor_counts(graph);
    std::vector<bool> done(counts.size(), false);
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < counts.size();) {
        if (done[i] || counts[i] > 0) {
            ++i;
            continue;
        }
        done[i] = true;
        order.push_back(i);
        for (const uint32_t next : graph.successors[i]) --counts[next];
        i = 0;
    }
    return order;
}

/// Walks unfinished systems backwards until one repeats: that loop is a cycle.
Error cycle_error(const ScheduleGraph& graph, const std::vector<uint32_t>& finished) {
    std::vector<bool> open(graph.names.size(), true);
    for (const uint32_t system : finished) open[system] = false;
    const auto open_predecessor = [&](uint32_t system) {
        for (uint32_t i = 0; i < open.size(); ++i) {
            const auto& next = graph.successors[i];
            if (open[i] && std::find(next.begin(), next.end(), system) != next.end()) return i;
        }
        return system;
    };
    std::vector<uint32_t> walk{
        static_cast<uint32_t>(std::find(open.begin(), open.end(), true) - open.begin())};
    auto repeat = walk.end();
    while (repeat == walk.end()) {
        const uint32_t previous = open_predecessor(walk.back());
        repeat = std::find(walk.begin(), walk.end(), previous);
        const auto at = repeat - walk.begin();
        const bool found = repeat != walk.end();
        walk.push_back(previous);
        repeat = found ? walk.begin() + at : walk.end();
    }
    std::vector<std::string> names;
    for (auto at = walk.end(); at != repeat;) names.push_back(graph.names[*--at]);
    return {fmt::format("systems are ordered in a cycle: {}", fmt::join(names, " -> ")), "",
            "drop one of these before/after declarations"};
}

std::string describe(const ScheduleGraph& graph, uint32_t a, uint32_t b,
                     const AccessConflict& conflict) {
    const auto verb = [](bool writes) { return writes ? "writes" : "reads"; };
    if (conflict.kind == "world") {
        const bool first = conflict.first_writes;
        return fmt::format("'{}' takes the whole World, and '{}' has no order with it",
                           graph.names[first ? a : b], graph.names[first ? b : a]);
    }
    return fmt::format("'{}' {} and '{}' {} {} '{}'", graph.names[a], verb(conflict.first_writes),
                       graph.names[b], verb(conflict.second_writes), conflict.kind, conflict.name);
}

std::optional<Error> find_ambiguities(const ScheduleGraph& graph,
                                      const Reachability& reachability) {
    std::vector<std::string> found;
    for (uint32_t a = 0; a < graph.names.size(); ++a) {
        for (uint32_t b = a + 1; b < graph.names.size(); ++b) {
            if (reachability.ordered(a, b)) continue;
            if (const auto conflict = find_conflict(graph.accesses[a], graph.accesses[b])) {
                found.push_back(describe(graph, a, b, *conflict));
            }
        }
    }
    if (found.empty()) return std::nullopt;
    return Error{fmt::format("ambiguous order: {}", fmt::join(found, "; ")), "",
                 "say which runs first with .before or .after"};
}

/// A phase ends where a system must see the Commands of one before it, and around exclusive ones.
std::vector<uint32_t> phases_of(const ScheduleGraph& graph, const std::vector<uint32_t>& order) {
    std::vector<uint32_t> phases(order.size(), 0);
    for (const uint32_t system : order) {
        const Access& access = graph.accesses[system];
        for (const uint32_t next : graph.successors[system]) {
            const bool cut = access.commands || access.exclusive || graph.accesses[next].exclusive;
            phases[next] = std::max(phases[next], phases[system] + (cut ? 1U : 0U));
        }
    }
    return phases;
}

}  // namespace

Result<ScheduleOrder> order_systems(const ScheduleGraph& graph) {
    std::vector<uint32_t> order = topological_order(graph);
    if (order.size() < graph.names.size()) return cycle_error(graph, order);
    if (auto error = find_ambiguities(graph, Reachability(graph, order))) return *std::move(error);
    std::vector<uint32_t> phases = phases_of(graph, order);
    return ScheduleOrder{std::move(order), std::move(phases)};
}

}  // namespace vellus
