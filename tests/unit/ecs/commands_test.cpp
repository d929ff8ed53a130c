#include "engine/ecs/commands.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "engine/ecs/query.h"

namespace vellus {
namespace {

struct Count {
    int value;
};
struct Name {
    std::unique_ptr<std::string> text;
};
struct Huge {
    std::array<char, 100'000> bytes;
};

TEST(Commands, DestroyWhileIterating) {
    World world;
    for (int i = 0; i < 1000; ++i) world.spawn(Count{i});
    Commands commands;
    const auto query = world.query<const Count>();
    query.each([&](Entity e, const Count& count) {
        if (count.value % 3 != 0) commands.destroy(e);
    });
    EXPECT_EQ(query.count(), 1000U);
    commands.apply(world);
    EXPECT_EQ(query.count(), 334U);
    query.each([](const Count& count) { EXPECT_EQ(count.value % 3, 0); });
}

TEST(Commands, AreAppliedInTheOrderRecorded) {
    World world;
    const Entity e = world.spawn(Count{1});
    Commands commands;
    commands.add(e, Count{2});
    commands.remove<Count>(e);
    commands.add(e, Count{3});
    commands.defer([e](World& w) { w.get<Count>(e)->value *= 10; });
    commands.add(e, Name{std::make_unique<std::string>("moved, not copied")});
    EXPECT_EQ(world.get<Count>(e)->value, 1);
    commands.apply(world);
    EXPECT_TRUE(commands.empty());
    EXPECT_EQ(world.get<Count>(e)->value, 30);
    EXPECT_EQ(*world.get<Name>(e)->text, "moved, not copied");
}

TEST(Commands, PendingEntitiesTakeFurtherCommands) {
    World world;
    Commands commands;
    const Entity first = commands.spawn(Count{1});
    const Entity second = commands.spawn();
    EXPECT_FALSE(world.alive(first));
    commands.add(second, Count{2});
    commands.add(first, Name{std::make_unique<std::string>("first")});
    const Entity third = commands.spawn(Count{3});
    commands.destroy(third);
    commands.apply(world);
    int sum = 0;
    world.query<const Count, const Name*>().each([&](const Count& count, const Name* name) {
        EXPECT_EQ(name != nullptr, count.value == 1);
        sum += count.value;
    });
    EXPECT_EQ(sum, 3);
    EXPECT_EQ(world.entity_count(), 2U);
}

TEST(Commands, DropChangesToEntitiesThatDiedMeanwhile) {
    World world;
    const Entity e = world.spawn(Count{1});
    Commands commands;
    commands.add(e, Name{std::make_unique<std::string>("too late")});
    commands.destroy(e);
    world.destroy(e);
    commands.apply(world);
    EXPECT_EQ(world.entity_count(), 0U);
}

TEST(Commands, HoldLargeAndManyChangesAndFreeThoseNeverApplied) {
    World world;
    const auto shared = std::make_shared<int>(0);
    {
        Commands commands;
        for (int i = 0; i < 500; ++i) commands.spawn(Count{i}, shared);
        commands.spawn(Huge{{'x'}});
        EXPECT_EQ(shared.use_count(), 501);
        commands.apply(world);
        EXPECT_EQ(world.entity_count(), 501U);
        EXPECT_EQ(shared.use_count(), 501);
        for (int i = 0; i < 500; ++i) commands.spawn(shared);
    }
    EXPECT_EQ(shared.use_count(), 501);
    int next = 0;
    world.query<const Count>().each([&](const Count& count) { EXPECT_EQ(count.value, next++); });
}

}  // namespace
}  // namespace vellus
