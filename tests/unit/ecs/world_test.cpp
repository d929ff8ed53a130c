#include "engine/ecs/world.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "engine/ecs/query.h"

namespace vellus {
namespace {

struct Position {
    float x, y, z;
};
struct Velocity {
    float x, y, z;
};
struct Name {
    std::string text;
};
struct Owner {
    std::unique_ptr<int> value;
};
struct Frozen {};

TEST(World, SpawnsEntitiesThatKeepTheirComponents) {
    World world;
    const Entity a =
        world.spawn(Position{1, 2, 3}, Name{"a name that is too long for the string itself"});
    const Entity b = world.spawn(Position{4, 5, 6});
    EXPECT_TRUE(world.alive(a));
    EXPECT_EQ(world.get<Position>(b)->y, 5);
    EXPECT_EQ(world.get<Name>(a)->text, "a name that is too long for the string itself");
    EXPECT_EQ(world.get<Name>(b), nullptr);
    EXPECT_TRUE(world.add(b, Name{"b"}));
    EXPECT_EQ(world.get<Position>(b)->y, 5);
    EXPECT_EQ(world.get<Name>(b)->text, "b");
    EXPECT_TRUE(world.remove<Position>(a));
    EXPECT_FALSE(world.remove<Position>(a));
    EXPECT_FALSE(world.has<Position>(a));
    EXPECT_EQ(world.get<Name>(a)->text, "a name that is too long for the string itself");
    EXPECT_TRUE(world.destroy(a));
    EXPECT_FALSE(world.destroy(a));
    EXPECT_FALSE(world.add(a, Position{}));
    EXPECT_EQ(world.get<Name>(a), nullptr);
    EXPECT_EQ(world.entity_count(), 1U);
}

TEST(World, MovesMoveOnlyComponents) {
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 100; ++i) entities.push_back(world.spawn(Owner{std::make_unique<int>(i)}));
    for (int i = 0; i < 100; i += 3) world.add(entities[i], Frozen{});
    for (int i = 0; i < 100; i += 7) world.destroy(entities[i]);
    for (int i = 0; i < 100; ++i) {
        const Owner* const owner = world.get<Owner>(entities[i]);
        ASSERT_EQ(owner == nullptr, i % 7 == 0) << i;
        if (owner != nullptr) {
            EXPECT_EQ(*owner->value, i);
        }
    }
}

}  // namespace
}  // namespace vellus
