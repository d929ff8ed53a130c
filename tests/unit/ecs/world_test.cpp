#include "engine/ecs/world.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/ecs/query.h"

namespace vellus {

/// Reaches what only 2^32 operations could.
struct WorldTestAccess {
    static void use_up_generations(World& world, Entity& entity) {
        world.find(entity)->generation = UINT32_MAX - 1;
        entity.generation = UINT32_MAX - 1;
    }
};

namespace {

struct Position {
    float x, y, z;
};
struct Name {
    std::string text;
};
struct Owner {
    std::unique_ptr<int> value;
};
struct Frozen {};
struct Gravity {
    float y;
};

TEST(World, EntitiesKeepTheirComponents) {
    World world;
    const std::string long_name = "a name that is too long for the string itself";
    const Entity a = world.spawn(Position{1, 2, 3}, Name{long_name});
    const Entity b = world.spawn(Position{4, 5, 6});
    EXPECT_EQ(world.get<Position>(b)->y, 5);
    EXPECT_EQ(world.get<Name>(b), nullptr);
    EXPECT_TRUE(world.add(b, Name{"b"}));
    EXPECT_TRUE(world.add(b, Name{"replaced"}));
    EXPECT_EQ(world.get<Position>(b)->y, 5);
    EXPECT_EQ(world.get<Name>(b)->text, "replaced");
    EXPECT_TRUE(world.remove<Position>(a));
    EXPECT_FALSE(world.remove<Position>(a));
    EXPECT_FALSE(world.has<Position>(a));
    EXPECT_EQ(world.get<Name>(a)->text, long_name);
}

TEST(World, ASpawnedCopyOfAComponentMayComeFromTheTableThatGrows) {
    World world;
    const Entity first = world.spawn(Name{"the one that all others copy, and long"});
    for (int i = 0; i < 100; ++i) world.spawn(*world.get<Name>(first));
    size_t equal = 0;
    world.query<const Name>().each([&](const Name& name) {
        equal += name.text == "the one that all others copy, and long" ? 1 : 0;
    });
    EXPECT_EQ(equal, 101U);
}

TEST(World, OperationsOnADeadEntitySayNo) {
    World world;
    const Entity e = world.spawn(Position{});
    EXPECT_TRUE(world.destroy(e));
    for (const Entity dead : {e, kNoEntity, Entity{77, 1}, Entity{0, 0}}) {
        EXPECT_FALSE(world.alive(dead));
        EXPECT_FALSE(world.destroy(dead));
        EXPECT_FALSE(world.add(dead, Position{}));
        EXPECT_FALSE(world.remove<Position>(dead));
        EXPECT_EQ(world.get<Position>(dead), nullptr);
        EXPECT_FALSE(world.query<Position>().get(dead).has_value());
    }
    EXPECT_EQ(world.entity_count(), 0U);
}

TEST(World, AReusedSlotHasANewGeneration) {
    World world;
    const Entity first = world.spawn(Position{1, 0, 0});
    world.destroy(first);
    const Entity second = world.spawn(Position{2, 0, 0});
    EXPECT_EQ(second.index, first.index);
    EXPECT_NE(second.generation, first.generation);
    EXPECT_FALSE(world.alive(first));
    EXPECT_EQ(world.get<Position>(second)->x, 2);
}

TEST(World, ASlotWhoseGenerationsAreUsedUpIsRetired) {
    World world;
    Entity last = world.spawn(Position{});
    WorldTestAccess::use_up_generations(world, last);
    ASSERT_TRUE(world.alive(last));
    EXPECT_TRUE(world.destroy(last));
    EXPECT_FALSE(world.alive(last));
    EXPECT_NE(world.spawn(Position{}).index, last.index);
}

TEST(World, MovesMoveOnlyComponents) {
    World world;
    std::vector<Entity> entities;
    entities.reserve(100);
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

TEST(World, DestroysEachComponentOnce) {
    const auto shared = std::make_shared<int>(1);
    {
        World world;
        const Entity a = world.spawn(shared, Position{});
        world.spawn(shared, Position{});
        EXPECT_EQ(shared.use_count(), 3);
        world.add(a, shared);
        EXPECT_EQ(shared.use_count(), 3);
        world.remove<std::shared_ptr<int>>(a);
        EXPECT_EQ(shared.use_count(), 2);
        world.spawn_many<std::shared_ptr<int>>(5, [&](size_t, auto& pointer) { pointer = shared; });
        EXPECT_EQ(shared.use_count(), 7);
    }
    EXPECT_EQ(shared.use_count(), 1);
}

// More than 2^20 entities: an index of 20 bits would wrap. Large columns also leave malloc and are
// remapped as they grow.
TEST(World, HoldsMoreThanAMillionEntities) {
    constexpr uint32_t kCount = 1'200'000;
    World world;
    std::vector<Entity> entities;
    for (uint32_t i = 0; i < kCount; ++i) {
        entities.push_back(world.spawn(Position{static_cast<float>(i), 1, 2}));
    }
    for (uint32_t i = 0; i < kCount; i += 2) world.add(entities[i], Gravity{-1});
    for (uint32_t i = 0; i < kCount; i += 3) world.destroy(entities[i]);
    size_t wrong = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const Position* const position = world.get<Position>(entities[i]);
        const bool dead = i % 3 == 0;
        if ((position == nullptr) != dead) ++wrong;
        if (position != nullptr && position->x != static_cast<float>(i)) ++wrong;
        if (world.has<Gravity>(entities[i]) != (!dead && i % 2 == 0)) ++wrong;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_EQ(world.entity_count(), kCount - (kCount + 2) / 3);
}

TEST(World, BulkSpawnReusesFreeSlotsAndValueInitialises) {
    World world;
    const Entity dead = world.spawn(Position{9, 9, 9});
    world.destroy(dead);
    const auto entities = world.spawn_many<Position, Name>(10);
    ASSERT_EQ(entities.size(), 10U);
    EXPECT_EQ(entities[0].index, dead.index);
    EXPECT_NE(entities[0].generation, dead.generation);
    for (const Entity entity : entities) {
        EXPECT_EQ(world.get<Position>(entity)->x, 0);
        EXPECT_EQ(world.get<Name>(entity)->text, "");
    }
    EXPECT_TRUE(world.spawn_many<Position>(0).empty());
}

TEST(World, ResourcesKeepTheirAddress) {
    World world;
    EXPECT_EQ(world.find_resource<Gravity>(), nullptr);
    const Gravity* const address = &world.insert_resource(Gravity{-9.8F});
    world.insert_resource(Name{"other"});
    world.insert_resource(Gravity{-1.6F});
    EXPECT_EQ(&world.resource<Gravity>(), address);
    EXPECT_EQ(world.resource<Gravity>().y, -1.6F);
}

TEST(WorldDeathTest, RefusesStructuralChangesWhileAQueryIterates) {
    World world;
    world.spawn(Position{});
    const auto query = world.query<Position>();
    const std::string why = "while a query iterates or systems run; use Commands";
    EXPECT_DEATH(query.each([&](Entity e, Position&) { world.destroy(e); }), "destroy " + why);
    EXPECT_DEATH(query.each([&](Entity e, Position&) { world.add(e, Name{}); }), "add " + why);
    EXPECT_DEATH(query.each([&](Entity e, Position&) { world.remove<Position>(e); }), why);
    EXPECT_DEATH(query.each_chunk([&](std::span<Position>) { world.spawn(Position{}); }), why);
    EXPECT_DEATH(world.spawn_many<Position>(1, [&](size_t, Position&) { world.spawn(); }), why);
}

TEST(WorldDeathTest, NamesTheMissingResourceAndTheDoubledComponent) {
    World world;
    EXPECT_DEATH((void)world.resource<Gravity>(), "no such resource in this world: .*Gravity");
    EXPECT_DEATH(world.spawn(Gravity{}, Gravity{}), "one component of each type");
}

}  // namespace
}  // namespace vellus
