#include "engine/ecs/schedule.h"

#include <gtest/gtest.h>

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

void move_bodies(Query<Position, const Velocity> bodies, Res<const Step> step) {
    bodies.each([&](Position& p, const Velocity& v) { p.x += v.x * step->seconds; });
}
void slow_down(Query<Velocity> bodies) {
    bodies.each([](Velocity& v) { v.x *= 0.5F; });
}

TEST(Schedule, NamesBothSystemsAndTheComponentOfAnAmbiguity) {
    World world;
    world.insert_resource(Step{0.5F});
    Schedule schedule("frame");
    schedule.add(move_bodies);
    schedule.add(slow_down);
    const auto built = schedule.build(world);
    ASSERT_FALSE(built);
    EXPECT_EQ(built.error().message(),
              "frame: ambiguous order: 'vellus::move_bodies' reads and 'vellus::slow_down' writes "
              "component '{anonymous}::Velocity' (say which runs first with .before or "
              ".after)");
}

TEST(Schedule, RunsInTheDeclaredOrder) {
    World world;
    world.insert_resource(Step{0.5F});
    const Entity e = world.spawn(Position{0}, Velocity{4});
    Schedule schedule;
    schedule.add(slow_down);
    schedule.add(move_bodies).before(slow_down);
    ASSERT_TRUE(schedule.build(world));
    schedule.run(world);
    EXPECT_EQ(world.get<Position>(e)->x, 2.0F);
    EXPECT_EQ(world.get<Velocity>(e)->x, 2.0F);
}

}  // namespace
}  // namespace vellus
