#include "engine/ecs/schedule.h"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <string>
#include <thread>
#include <vector>

#include "oneapi/tbb/global_control.h"
#include "oneapi/tbb/info.h"

namespace vellus {
namespace {

struct Position {
    float x;
};
struct Velocity {
    float x;
};
struct Step {
    float seconds;
};
struct Log {
    std::vector<std::string> lines;
};
struct Player {};

void move_bodies(Query<Position, const Velocity> bodies, Res<const Step> step) {
    bodies.each([&](Position& p, const Velocity& v) { p.x += v.x * step->seconds; });
}
void slow_down(Query<Velocity> bodies) {
    bodies.each([](Velocity& v) { v.x *= 0.5F; });
}
void read_bodies(Query<const Position, const Velocity>) {}

std::string error_of(Schedule& schedule, World& world) {
    const auto built = schedule.build(world);
    return built ? "" : built.error().message();
}

auto writes(const char* line) {
    return [line](Res<Log> log) { log->lines.emplace_back(line); };
}

TEST(Schedule, RunsInTheDeclaredOrder) {
    World world;
    world.insert_resource(Step{0.5F});
    const Entity e = world.spawn(Position{0}, Velocity{4});
    Schedule schedule;
    schedule.add(slow_down);
    schedule.add(move_bodies).before(slow_down);
    ASSERT_EQ(error_of(schedule, world), "");
    schedule.run(world);
    EXPECT_EQ(world.get<Position>(e)->x, 2.0F);
    EXPECT_EQ(world.get<Velocity>(e)->x, 2.0F);
    EXPECT_EQ(schedule.system_names(),
              (std::vector<std::string_view>{"vellus::move_bodies", "vellus::slow_down"}));
}

TEST(Schedule, AnAmbiguityNamesBothSystemsAndTheComponent) {
    World world;
    world.insert_resource(Step{0.5F});
    Schedule schedule("frame");
    schedule.add(move_bodies);
    schedule.add(slow_down);
    EXPECT_EQ(error_of(schedule, world),
              "frame: ambiguous order: 'vellus::move_bodies' reads and 'vellus::slow_down' writes "
              "component '{anonymous}::Velocity' (say which runs first with .before or .after)");
}

TEST(Schedule, AnAmbiguityNamesTheResourceOrTheWorld) {
    World world;
    world.insert_resource(Log{});
    Schedule schedule;
    schedule.add("first", writes("first"));
    schedule.add("second", [](Res<const Log>) {});
    schedule.add("third", [](World&) {}).after("first");
    const std::string error = error_of(schedule, world);
    EXPECT_NE(error.find("'first' writes and 'second' reads resource '{anonymous}::Log'"),
              std::string::npos)
        << error;
    EXPECT_NE(error.find("'third' takes the whole World, and 'second' has no order with it"),
              std::string::npos)
        << error;
}

TEST(Schedule, ReadersAndDisjointQueriesDoNotConflict) {
    World world;
    Schedule schedule;
    schedule.add("read again", [](Query<const Position>) {});
    schedule.add(read_bodies);
    schedule.add("players", [](Query<Player, With<Velocity>>) {});
    EXPECT_EQ(error_of(schedule, world), "");

    Schedule disjoint;
    disjoint.add("players", [](Query<Position, With<Player>>) {});
    disjoint.add("others", [](Query<Position, Without<Player>>) {});
    EXPECT_EQ(error_of(disjoint, world), "");
    disjoint.add("optional", [](Query<const Position*, Without<Player>>) {}).after("players");
    EXPECT_NE(error_of(disjoint, world).find("'others' writes and 'optional' reads component"),
              std::string::npos);
}

TEST(Schedule, OrderIsTransitiveAndGoesThroughSets) {
    World world;
    world.insert_resource(Log{});
    Schedule schedule;
    schedule.add("draw", writes("draw")).in("render");
    schedule.add("move", writes("move")).in("simulate").after("think");
    schedule.add("think", writes("think")).in("simulate");
    schedule.add("read keys", writes("read keys")).in("input");
    schedule.add("present", writes("present")).after("render");
    schedule.order({"input", "simulate", "empty", "render"});
    ASSERT_EQ(error_of(schedule, world), "");
    schedule.run(world);
    EXPECT_EQ(world.resource<Log>().lines,
              (std::vector<std::string>{"read keys", "think", "move", "draw", "present"}));
}

TEST(Schedule, ACycleNamesItsSystems) {
    World world;
    Schedule schedule;
    schedule.add("start", [](Query<Position>) {}).before("a");
    schedule.add("a", [](Query<Position>) {}).before("b");
    schedule.add("b", [](Query<Position>) {}).before("c");
    schedule.add("c", [](Query<Position>) {}).before("a");
    schedule.add("end", [](Query<Position>) {}).after("c");
    const std::string error = error_of(schedule, world);
    EXPECT_NE(error.find("systems are ordered in a cycle: "), std::string::npos) << error;
    const std::string turns[] = {"a -> b -> c -> a", "b -> c -> a -> b", "c -> a -> b -> c"};
    EXPECT_TRUE(std::any_of(std::begin(turns), std::end(turns), [&](const std::string& turn) {
        return error.find(": " + turn + " (") != std::string::npos;
    })) << error;

    Schedule self;
    self.add("a", [] {}).before("a");
    EXPECT_NE(error_of(self, world).find("cycle: a -> a"), std::string::npos);
}

TEST(Schedule, ReportsUnknownAndDoubledNamesAndMissingResources) {
    World world;
    Schedule unknown("update");
    unknown.add("a", [] {}).after("nothing");
    EXPECT_EQ(
        error_of(unknown, world),
        "update: system 'a' is ordered after 'nothing', which this schedule does not have (add "
        "that system or set, or drop the declaration)");
    Schedule unknown_function;
    unknown_function.add("a", [] {}).before(slow_down);
    EXPECT_NE(error_of(unknown_function, world).find("before 'vellus::slow_down'"),
              std::string::npos);
    Schedule doubled;
    doubled.add(slow_down);
    doubled.add(slow_down);
    EXPECT_NE(error_of(doubled, world).find("two systems are called 'vellus::slow_down'"),
              std::string::npos);
    Schedule set;
    set.add("a", [] {}).in("b");
    set.add("b", [] {});
    EXPECT_NE(error_of(set, world).find("'b' names both a system and a set"), std::string::npos);
    Schedule missing;
    missing.add(move_bodies);
    EXPECT_NE(error_of(missing, world)
                  .find("system 'vellus::move_bodies' needs resource '{anonymous}::Step'"),
              std::string::npos);
}

// Two systems that each wait until the other has begun can only end if they run at the same time.
TEST(Schedule, SystemsThatDoNotConflictRunAtTheSameTime) {
    const oneapi::tbb::global_control two_threads(
        oneapi::tbb::global_control::max_allowed_parallelism, 2);
    if (oneapi::tbb::info::default_concurrency() < 2) GTEST_SKIP() << "one core";
    World world;
    std::barrier meeting(2);
    Schedule schedule;
    schedule.add("positions", [&](Query<Position>) { meeting.arrive_and_wait(); });
    schedule.add("velocities", [&](Query<Velocity>) { meeting.arrive_and_wait(); });
    ASSERT_EQ(error_of(schedule, world), "");
    for (int i = 0; i < 20; ++i) schedule.run(world);
}

TEST(Schedule, OrderedSystemsNeverOverlap) {
    World world;
    Schedule schedule;
    std::atomic<int> running{0};
    std::vector<int> order;
    for (int i = 0; i < 30; ++i) {
        const std::string name = "writer " + std::to_string(i);
        auto& added = schedule.add(name, [&, i](Query<Position>) {
            EXPECT_EQ(running.fetch_add(1), 0);
            order.push_back(i);
            running.fetch_sub(1);
        });
        if (i > 0) added.after("writer " + std::to_string(i - 1));
        schedule.add("bystander " + std::to_string(i), [](Query<const Velocity>) {});
    }
    ASSERT_EQ(error_of(schedule, world), "");
    for (int run = 0; run < 50; ++run) {
        order.clear();
        schedule.run(world);
        ASSERT_TRUE(std::is_sorted(order.begin(), order.end()));
        ASSERT_EQ(order.size(), 30U);
    }
}

TEST(Schedule, ALaterSystemSeesTheCommandsOfOneItIsOrderedAfter) {
    World world;
    size_t seen = 0;
    Schedule schedule;
    schedule.add("spawn", [](Commands& commands) { commands.spawn(Position{1}); });
    schedule.add("count", [&](Query<const Position> bodies) { seen = bodies.count(); })
        .after("spawn");
    schedule
        .add("clear",
             [](Query<Entity, const Position> bodies, Commands& commands) {
                 bodies.each([&](Entity e, const Position&) { commands.destroy(e); });
             })
        .after("count");
    ASSERT_EQ(error_of(schedule, world), "");
    for (int run = 0; run < 3; ++run) {
        schedule.run(world);
        EXPECT_EQ(seen, 1U);
        EXPECT_EQ(world.entity_count(), 0U);
    }
}

// Four systems record at the same time, each giving way at another moment in each run; entities,
// handles included, must come out the same.
TEST(Schedule, CommandsDoNotDependOnThreadTiming) {
    std::vector<std::vector<Entity>> outcomes;
    for (int attempt = 0; attempt < 20; ++attempt) {
        World world;
        Schedule schedule;
        for (int s = 0; s < 4; ++s) {
            schedule.add("spawner " + std::to_string(s), [attempt, s](Commands& commands) {
                for (int i = 0; i < 50; ++i) {
                    if ((i * 7 + attempt * 13 + s * 5) % 11 == 0) std::this_thread::yield();
                    const Entity e = commands.spawn(Position{static_cast<float>(s * 100 + i)});
                    if (i % 5 == 0) commands.destroy(e);
                }
            });
        }
        ASSERT_EQ(error_of(schedule, world), "");
        schedule.run(world);
        std::vector<Entity> by_value(400, kNoEntity);
        world.query<const Position>().each([&](Entity e, const Position& position) {
            by_value[static_cast<size_t>(position.x)] = e;
        });
        outcomes.push_back(by_value);
    }
    for (const auto& outcome : outcomes) EXPECT_EQ(outcome, outcomes.front());
    EXPECT_NE(outcomes.front()[1], kNoEntity);
}

TEST(Schedule, AnExclusiveSystemMayChangeTheWorldDirectly) {
    World world;
    Schedule schedule;
    schedule.add("spawn", [](World& w) { w.spawn(Position{1}); });
    schedule.add("double", [](Query<Position> all) { all.each([](Position& p) { p.x *= 2; }); })
        .after("spawn");
    ASSERT_EQ(error_of(schedule, world), "");
    schedule.run(world);
    schedule.run(world);
    float sum = 0;
    world.query<const Position>().each([&](const Position& p) { sum += p.x; });
    EXPECT_EQ(sum, 4 + 2);
}

TEST(ScheduleDeathTest, RefusesWhatItsContractForbids) {
    World world;
    Schedule schedule("update");
    EXPECT_DEATH(schedule.run(world), "update: run needs a successful build for this world");
    schedule.add("smuggle", [&](Query<Position>) { world.spawn(Position{}); });
    ASSERT_EQ(error_of(schedule, world), "");
    EXPECT_DEATH(schedule.run(world), "spawn while a query iterates or systems run");
    World other;
    EXPECT_DEATH(schedule.run(other), "needs a successful build for this world");
    schedule.add("more", [] {});
    EXPECT_DEATH(schedule.run(world), "since the last add");
}

}  // namespace
}  // namespace vellus
