#include "engine/ecs/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "engine/ecs/contract.h"
#include "engine/ecs/executor.h"
#include "engine/ecs/schedule_graph.h"
#include "engine/ecs/symbol_name.h"

namespace vellus {
namespace {

struct Entry {
    std::string name;
    FunctionKey key;
    std::unique_ptr<System> system;
    std::unique_ptr<SystemOrder> order;  // its address is what add returned
};

}  // namespace

SystemOrder& SystemOrder::before(std::string_view name) {
    constraints_.push_back({nullptr, std::string(name), true});
    return *this;
}

SystemOrder& SystemOrder::after(std::string_view name) {
    constraints_.push_back({nullptr, std::string(name), false});
    return *this;
}

SystemOrder& SystemOrder::in(std::string_view set) {
    sets_.emplace_back(set);
    return *this;
}

SystemOrder& SystemOrder::order(FunctionKey function, bool before) {
    constraints_.push_back({function, symbol_name(function), before});
    return *this;
}

struct Schedule::State {
    std::string name;
    std::vector<Entry> entries;
    std::vector<std::string> sets;                                // named by order()
    std::vector<std::pair<std::string, std::string>> set_chains;  // first before second
    World* world = nullptr;                                       // built for; null when not
    std::unique_ptr<Executor> executor;
    std::vector<uint32_t> order;

    using Members = std::map<std::string, std::vector<uint32_t>, std::less<>>;

    [[nodiscard]] Result<Members> members() const;
    [[nodiscard]] Result<ScheduleGraph> graph() const;
    [[nodiscard]] Result<std::vector<uint32_t>> resolve(const Members& members, uint32_t system,
                                                        const SystemOrder::Constraint& to) const;
    [[nodiscard]] Result<void> check_resources(const World& of, const ScheduleGraph& graph) const;
};

/// What each name stands for: a system for itself, a set for its systems.
Result<Schedule::State::Members> Schedule::State::members() const {
    Members members;
    for (uint32_t i = 0; i < entries.size(); ++i) {
        if (!members.try_emplace(entries[i].name, 1, i).second) {
            return Error{fmt::format("two systems are called '{}'", entries[i].name), name,
                         "add one of them under another name"};
        }
    }
    Members groups;
    for (const std::string& set : sets) groups[set];
    for (uint32_t i = 0; i < entries.size(); ++i) {
        for (const std::string& set : entries[i].order->sets_) groups[set].push_back(i);
    }
    for (auto& [set, systems] : groups) {
        if (!members.try_emplace(set, std::move(systems)).second) {
            return Error{fmt::format("'{}' names both a system and a set", set), name,
                         "rename one of them"};
        }
    }
    return members;
}

Result<std::vector<uint32_t>> Schedule::State::resolve(const Members& members, uint32_t system,
                                                       const SystemOrder::Constraint& to) const {
    if (to.function != nullptr) {
        for (uint32_t i = 0; i < entries.size(); ++i) {
            if (entries[i].key == to.function) return std::vector<uint32_t>{i};
        }
    } else if (const auto found = members.find(to.name); found != members.end()) {
        return found->second;
    }
    return Error{fmt::format("system '{}' is ordered {} '{}', which this schedule does not have",
                             entries[system].name, to.before ? "before" : "after", to.name),
                 name, "add that system or set, or drop the declaration"};
}

Result<ScheduleGraph> Schedule::State::graph() const {
    const auto named = members();
    if (!named) return named.error();
    ScheduleGraph graph;
    graph.successors.resize(entries.size());
    const auto connect = [&](const std::vector<uint32_t>& first,
                             const std::vector<uint32_t>& then) {
        for (const uint32_t a : first) {
            graph.successors[a].insert(graph.successors[a].end(), then.begin(), then.end());
        }
    };
    for (uint32_t i = 0; i < entries.size(); ++i) {
        graph.names.push_back(entries[i].name);
        graph.accesses.push_back(entries[i].system->access());
        for (const SystemOrder::Constraint& constraint : entries[i].order->constraints_) {
            const auto others = resolve(*named, i, constraint);
            if (!others) return others.error();
            if (constraint.before) connect({i}, *others);
            if (!constraint.before) connect(*others, {i});
        }
    }
    for (const auto& [first, then] : set_chains) {
        connect(named->find(first)->second, named->find(then)->second);
    }
    for (auto& next : graph.successors) {
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
    }
    return graph;
}

Result<void> Schedule::State::check_resources(const World& of, const ScheduleGraph& graph) const {
    for (size_t i = 0; i < graph.names.size(); ++i) {
        for (const TypeAccess& resource : graph.accesses[i].resources) {
            if (of.find_resource(resource.id) != nullptr) continue;
            return Error{
                fmt::format("system '{}' needs resource '{}', which the world does not have",
                            graph.names[i], resource.name),
                name, "insert the resource before the schedule is built"};
        }
    }
    return {};
}

Schedule::Schedule(std::string name) : state_(std::make_unique<State>()) {
    state_->name = std::move(name);
}
Schedule::~Schedule() = default;
Schedule::Schedule(Schedule&&) noexcept = default;
Schedule& Schedule::operator=(Schedule&&) noexcept = default;

SystemOrder& Schedule::add_function(std::unique_ptr<System> system, FunctionKey key,
                                    SourceLine where) {
    std::string name = symbol_name(key);
    if (name.empty()) name = fmt::format("{}:{}", where.file, where.line);
    return add_system(std::move(name), key, std::move(system));
}

SystemOrder& Schedule::add_system(std::string name, FunctionKey key,
                                  std::unique_ptr<System> system) {
    state_->world = nullptr;
    state_->entries.push_back(
        {std::move(name), key, std::move(system), std::make_unique<SystemOrder>()});
    return *state_->entries.back().order;
}

void Schedule::order(std::initializer_list<std::string_view> sets) {
    state_->world = nullptr;
    for (const std::string_view& set : sets) {
        state_->sets.emplace_back(set);
        // Also across a set that is empty: each with all before it.
        for (const std::string_view* first = sets.begin(); first != &set; ++first) {
            state_->set_chains.emplace_back(*first, set);
        }
    }
}

Result<void> Schedule::build(World& world) {
    state_->world = nullptr;
    const auto graph = state_->graph();
    if (!graph) return graph.error();
    auto ordered = order_systems(*graph);
    if (!ordered) {
        Error error = ordered.error();
        error.where = state_->name;
        return error;
    }
    if (auto found = state_->check_resources(world, *graph); !found) return found;
    std::vector<System*> systems;
    for (const Entry& entry : state_->entries) {
        entry.system->prepare(world);
        systems.push_back(entry.system.get());
    }
    state_->executor = std::make_unique<Executor>(systems, *graph, *ordered);
    state_->order = std::move((*ordered).order);
    state_->world = &world;
    return {};
}

void Schedule::run(World& world) {
    if (state_->world != &world) {
        contract_failed(
            fmt::format("ecs: {}: run needs a successful build for this world since the "
                        "last add or order",
                        state_->name));
    }
    state_->executor->run(world);
}

std::vector<std::string_view> Schedule::system_names() const {
    std::vector<std::string_view> names;
    if (state_->world == nullptr) return names;
    for (const uint32_t system : state_->order) names.emplace_back(state_->entries[system].name);
    return names;
}

}  // namespace vellus
