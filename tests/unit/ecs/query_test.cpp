#include "engine/ecs/query.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "engine/ecs/world.h"

namespace vellus {
namespace {

struct A {
    int value;
};
struct B {
    int value;
};
struct Tag {};

class QueryOverAllMixtures : public testing::Test {
  protected:
    QueryOverAllMixtures() {
        for (int i = 0; i < 80; ++i) {
            const Entity e = world.spawn();
            if ((i & 1) != 0) world.add(e, A{i});
            if ((i & 2) != 0) world.add(e, B{i});
            if ((i & 4) != 0) world.add(e, Tag{});
            entities.push_back(e);
        }
    }

    World world;
    std::vector<Entity> entities;
};

TEST_F(QueryOverAllMixtures, FiltersByPresence) {
    EXPECT_EQ((world.query<A, const B>().count()), 20U);
    EXPECT_EQ((world.query<A, With<Tag>>().count()), 20U);
    EXPECT_EQ((world.query<A, Without<B>, Without<Tag>>().count()), 10U);
    EXPECT_EQ((world.query<const A*, With<B>>().count()), 40U);
    EXPECT_EQ(world.query<Entity>().count(), 80U);
    EXPECT_EQ((world.query<A, Without<A>>().count()), 0U);
    EXPECT_TRUE((world.query<A, Without<A>>().empty()));
}

TEST_F(QueryOverAllMixtures, FindsTablesThatAppearLater) {
    struct Late {};
    const auto query = world.query<A, With<Late>>();
    EXPECT_EQ(query.count(), 0U);
    world.add(entities[1], Late{});
    world.add(entities[3], Late{});
    EXPECT_EQ(query.count(), 2U);
}

TEST_F(QueryOverAllMixtures, YieldsReferencesPointersAndEntities) {
    size_t seen = 0;
    world.query<Entity, A, const B*>().each([&](Entity e, A& a, const B* b) {
        EXPECT_EQ(entities[static_cast<size_t>(a.value)], e);
        EXPECT_EQ(b != nullptr, (a.value & 2) != 0);
        a.value += 1000;
        ++seen;
    });
    EXPECT_EQ(seen, 40U);
    EXPECT_EQ(world.get<A>(entities[5])->value, 1005);
}

TEST_F(QueryOverAllMixtures, ChunksCoverEachEntityOnce) {
    std::vector<int> seen(entities.size(), 0);
    world.query<const A, const B*>().each_chunk(
        [&](std::span<const Entity> who, std::span<const A> a, std::span<const B> b) {
            ASSERT_EQ(who.size(), a.size());
            ASSERT_TRUE(b.empty() || b.size() == a.size());
            for (size_t i = 0; i < a.size(); ++i) {
                ASSERT_EQ(entities[static_cast<size_t>(a[i].value)], who[i]);
                ++seen[static_cast<size_t>(a[i].value)];
            }
        });
    for (size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], i % 2 == 1 ? 1 : 0);
}

TEST_F(QueryOverAllMixtures, GetsOneEntityOnlyWhereItMatches) {
    const auto query = world.query<A, const B*, Without<Tag>>();
    const auto one = query.get(entities[1]);
    ASSERT_TRUE(one.has_value());
    EXPECT_EQ(std::get<0>(*one).value, 1);
    EXPECT_EQ(std::get<1>(*one), nullptr);
    EXPECT_EQ(std::get<1>(*query.get(entities[3]))->value, 3);
    EXPECT_FALSE(query.get(entities[2]).has_value());
    EXPECT_FALSE(query.get(entities[5]).has_value());
}

TEST(Query, VisitsEachEntityOnceInParallel) {
    constexpr size_t kCount = 100'000;
    World world;
    world.spawn_many<A>(kCount, [](size_t i, A& a) { a.value = static_cast<int>(i); });
    std::atomic<size_t> sum{0};
    world.query<A>().parallel_each([&](A& a) {
        sum.fetch_add(static_cast<size_t>(a.value), std::memory_order_relaxed);
        a.value = -1;
    });
    EXPECT_EQ(sum.load(), kCount * (kCount - 1) / 2);
    world.query<const A>().each([](const A& a) { ASSERT_EQ(a.value, -1); });
}

}  // namespace
}  // namespace vellus
