#include <fmt/format.h>

#include <array>
#include <memory>

#include "engine/ecs/ecs.h"
#include "tests/perf/ecs_baseline.h"
#include "tests/perf/ecs_cases.h"

namespace vellus::bench {
namespace {

constexpr size_t kVisitsPerRun = 8'000'000;
constexpr size_t kArchetypes = 16;

// Small whole numbers, so that sums of floats are exact however often a loop runs.
Position start_position(size_t i) {
    return {static_cast<float>(i % 1024), 0, 1};
}
Velocity velocity_of(size_t i) {
    return {1, static_cast<float>(i % 3), -1};
}

bool moved(const Position& p, const Velocity& v, float passes) {
    return p.y == v.y * passes && p.z == 1 + v.z * passes;
}

struct Iteration {
    World world;
    std::vector<HandTable<Position, Velocity>> tables;
    size_t passes;
    size_t count;
    float vellus_passes = 0;
    float hand_passes = 0;

    explicit Iteration(size_t entities)
        : passes(std::max<size_t>(1, kVisitsPerRun / entities)), count(entities) {}

    Timed run_vellus() {
        auto query = world.query<Position, const Velocity>();
        const double seconds = seconds_of([&] {
            for (size_t pass = 0; pass < passes; ++pass) {
                query.each([](Position& p, const Velocity& v) {
                    p.x += v.x;
                    p.y += v.y;
                    p.z += v.z;
                });
            }
        });
        vellus_passes += static_cast<float>(passes);
        bool good = query.count() == count;
        query.each(
            [&](const Position& p, const Velocity& v) { good &= moved(p, v, vellus_passes); });
        return {seconds, good};
    }

    Timed run_by_hand() {
        const double seconds = seconds_of([&] {
            for (size_t pass = 0; pass < passes; ++pass) {
                for (auto& table : tables) {
                    auto& positions = table.column<Position>();
                    const auto& velocities = table.column<Velocity>();
                    for (size_t i = 0; i < positions.size(); ++i) {
                        positions[i].x += velocities[i].x;
                        positions[i].y += velocities[i].y;
                        positions[i].z += velocities[i].z;
                    }
                }
            }
        });
        hand_passes += static_cast<float>(passes);
        bool good = true;
        for (auto& table : tables) {
            for (size_t i = 0; i < table.handles.size(); ++i) {
                good &=
                    moved(table.column<Position>()[i], table.column<Velocity>()[i], hand_passes);
            }
        }
        return {seconds, good};
    }
};

EcsCase make_case(double target, const std::shared_ptr<Iteration>& state) {
    return {target, state->passes * state->count, [state] { return state->run_vellus(); },
            [state] { return state->run_by_hand(); }};
}

HandTable<Position, Velocity> hand_table(size_t first, size_t count) {
    HandTable<Position, Velocity> table;
    for (size_t i = first; i < first + count; ++i) {
        table.push({static_cast<uint32_t>(i), 0}, start_position(i), velocity_of(i));
    }
    return table;
}

EcsCase one_archetype(size_t count) {
    auto state = std::make_shared<Iteration>(count);
    state->world.spawn_many<Position, Velocity>(count, [](size_t i, Position& p, Velocity& v) {
        p = start_position(i);
        v = velocity_of(i);
    });
    state->tables.push_back(hand_table(0, count));
    return make_case(1.1, state);
}

template <int kBit>
struct Mark {
    int32_t value;
};

template <size_t kMask>
void spawn_marked(World& world, size_t first, size_t count) {
    for (const Entity entity : std::vector<Entity>([&] {
             const auto span = world.spawn_many<Position, Velocity>(
                 count, [&](size_t i, Position& p, Velocity& v) {
                     p = start_position(first + i);
                     v = velocity_of(first + i);
                 });
             return std::vector<Entity>(span.begin(), span.end());
         }())) {
        if constexpr ((kMask & 1U) != 0) world.add(entity, Mark<0>{});
        if constexpr ((kMask & 2U) != 0) world.add(entity, Mark<1>{});
        if constexpr ((kMask & 4U) != 0) world.add(entity, Mark<2>{});
        if constexpr ((kMask & 8U) != 0) world.add(entity, Mark<3>{});
    }
}

EcsCase mixed_archetypes(size_t count) {
    auto state = std::make_shared<Iteration>(count);
    const size_t each = count / kArchetypes;
    [&]<size_t... kMasks>(std::index_sequence<kMasks...>) {
        (spawn_marked<kMasks>(state->world, kMasks * each, each), ...);
    }
    (std::make_index_sequence<kArchetypes>{});
    for (size_t i = 0; i < kArchetypes; ++i) state->tables.push_back(hand_table(i * each, each));
    return make_case(1.2, state);
}

}  // namespace

std::vector<EcsCaseMaker> iteration_cases(bool quick) {
    std::vector<size_t> counts{10'000, 1'000'000, 8'000'000};
    if (quick) counts = {10'000, 100'000};
    std::vector<EcsCaseMaker> makers;
    makers.reserve(counts.size() + 1);
    for (const size_t count : counts) {
        makers.push_back({fmt::format("iterate 2 components, {} entities", count),
                          [count] { return one_archetype(count); }});
    }
    const size_t mixed = quick ? 16'000 : 1'000'000;
    makers.push_back({fmt::format("iterate 16 mixed archetypes, {} entities", mixed),
                      [mixed] { return mixed_archetypes(mixed); }});
    return makers;
}

}  // namespace vellus::bench
