#include "modules/scene/transform.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/ecs/schedule.h"
#include "engine/platform/log.h"
#include "modules/scene/register.h"
#include "modules/scene/view.h"

namespace vellus::scene {
namespace {

class Transforms : public testing::Test {
  protected:
    void SetUp() override {
        register_scene(world, schedule);
        const auto built = schedule.build(world);
        ASSERT_TRUE(built) << built.error().message();
    }
    Entity spawn(const LocalTransform& local) {
        return world.spawn(local, WorldTransform{}, PreviousWorldTransform{});
    }
    Entity spawn(const LocalTransform& local, Entity parent) {
        return world.spawn(local, WorldTransform{}, PreviousWorldTransform{}, Parent{parent});
    }
    const glm::dmat4& world_of(Entity e) { return world.get<WorldTransform>(e)->matrix; }

    World world;
    Schedule schedule{"test"};
};

double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0.0;
    for (int i = 0; i < 4; ++i) most = std::max(most, glm::length(a[i] - b[i]));
    return most;
}

LocalTransform random_transform(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const glm::quat q(unit(random), unit(random), unit(random), unit(random));
    return {glm::dvec3(unit(random), unit(random), unit(random)), glm::normalize(q),
            glm::vec3(1.0f) + 0.2f * glm::vec3(unit(random), unit(random), unit(random))};
}

TEST_F(Transforms, MatrixIsTranslationRotationScale) {
    const LocalTransform t{
        {1, 2, 3}, glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 1, 0)), {2, 3, 4}};
    // +X scaled by 2 turns to -Z; +Y by 3 stays.
    const glm::dvec4 x = to_matrix(t) * glm::dvec4(1, 0, 0, 1);
    const glm::dvec4 y = to_matrix(t) * glm::dvec4(0, 1, 0, 1);
    EXPECT_LT(glm::length(x - glm::dvec4(1, 2, 1, 1)), 1e-6);
    EXPECT_LT(glm::length(y - glm::dvec4(1, 5, 3, 1)), 1e-6);
}

TEST_F(Transforms, EveryChainEqualsTheProductAlongIt) {
    // Parents and a second archetype are given in shuffled order, so that children often precede
    // their parents in the tables.
    std::mt19937 random(7);
    constexpr int kCount = 600;
    std::vector<LocalTransform> locals;
    std::vector<int> parent(kCount, -1);
    std::vector<Entity> entities;
    std::vector<int> shuffled;
    for (int i = 0; i < kCount; ++i) {
        locals.push_back(random_transform(random));
        if (i % 13 != 0) parent[i] = static_cast<int>(random() % i);
        entities.push_back(spawn(locals[i]));
        shuffled.push_back(i);
    }
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (const int i : shuffled) {
        if (parent[i] >= 0) world.add(entities[i], Parent{entities[parent[i]]});
        if (i % 3 == 0) world.add(entities[i], Name{"third"});
    }
    schedule.run(world);
    for (int i = 0; i < kCount; ++i) {
        glm::dmat4 expected = to_matrix(locals[i]);
        for (int up = parent[i]; up >= 0; up = parent[up]) {
            expected = to_matrix(locals[up]) * expected;
        }
        // Doubles: rounding over at most some 20 products of numbers near 1.
        EXPECT_LT(difference(world_of(entities[i]), expected), 1e-11) << i;
    }
}

TEST_F(Transforms, PreviousFollowsOneFrameBehindAndStartsStill) {
    const Entity e = spawn({{1, 0, 0}});
    schedule.run(world);
    EXPECT_EQ(world.get<PreviousWorldTransform>(e)->matrix[3].x, 1.0);
    world.get<LocalTransform>(e)->translation.x = 5.0;
    schedule.run(world);
    EXPECT_EQ(world.get<PreviousWorldTransform>(e)->matrix[3].x, 1.0);
    EXPECT_EQ(world_of(e)[3].x, 5.0);
    world.get<PreviousWorldTransform>(e)->known = false;  // teleport
    world.get<LocalTransform>(e)->translation.x = 9.0;
    schedule.run(world);
    EXPECT_EQ(world.get<PreviousWorldTransform>(e)->matrix[3].x, 9.0);
}

TEST_F(Transforms, StructureIsDerivedAgainOnlyWhenItChanged) {
    const Entity a = spawn({{1, 0, 0}});
    const Entity b = spawn({{0, 2, 0}}, a);
    schedule.run(world);
    const uint64_t rebuilds = world.resource<Hierarchy>().rebuilds;
    for (int i = 0; i < 5; ++i) schedule.run(world);
    EXPECT_EQ(world.resource<Hierarchy>().rebuilds, rebuilds);
    const Entity c = spawn({{0, 0, 3}}, b);
    world.add(b, Parent{kNoEntity});
    schedule.run(world);
    EXPECT_EQ(world.resource<Hierarchy>().rebuilds, rebuilds + 1);
    EXPECT_EQ(world_of(c)[3], glm::dvec4(0, 2, 3, 1));
}

TEST_F(Transforms, ChildrenOfTheDeadBecomeRoots) {
    const Entity a = spawn({{1, 0, 0}});
    const Entity b = spawn({{0, 2, 0}}, a);
    schedule.run(world);
    EXPECT_EQ(world_of(b)[3], glm::dvec4(1, 2, 0, 1));
    world.destroy(a);
    (void)spawn({{100, 0, 0}});  // takes over the slot under a new generation
    schedule.run(world);
    EXPECT_EQ(world_of(b)[3], glm::dvec4(0, 2, 0, 1));
}

TEST_F(Transforms, ACycleIsCutAndReported) {
    std::string logged;
    const LogSink before = set_log_sink([&](LogLevel, std::string_view line) { logged += line; });
    const Entity a = spawn({{1, 0, 0}});
    const Entity b = spawn({{1, 0, 0}}, a);
    const Entity c = spawn({{1, 0, 0}}, b);
    world.add(a, Parent{b});
    schedule.run(world);
    set_log_sink(before);
    EXPECT_NE(logged.find("its own ancestor"), std::string::npos) << logged;
    EXPECT_EQ(world_of(c)[3].x, world_of(b)[3].x + 1.0);
    for (const Entity e : {a, b}) EXPECT_LE(world_of(e)[3].x, 2.0);
}

TEST_F(Transforms, AMillionMetresFromTheOriginMillimetresRemain) {
    // A head joint 1.7 m up a turned root at 1e6 m; a camera 2 m away.
    std::mt19937 random(3);
    const glm::dvec3 far_away(1e6, -1e6, 1e6);
    const LocalTransform turned = random_transform(random);
    const auto chain = [&](const glm::dvec3& offset) {
        LocalTransform root = turned;
        root.translation += offset;
        const Entity spine = spawn({{0.0, 1.0, 0.0}, turned.rotation}, spawn(root));
        return spawn({{0.1, 0.7, 0.0}, turned.rotation}, spine);
    };
    const Entity here = chain(glm::dvec3(0.0));
    const Entity there = chain(far_away);
    schedule.run(world);
    const glm::dvec3 camera(0.5, 1.0, 2.0);
    const glm::mat4x3 near_matrix = relative_affine(world_of(here), camera);
    const glm::mat4x3 far_matrix = relative_affine(world_of(there), far_away + camera);
    // A double holds 1e6 m to 1e-10 m; float then rounds metres to 1e-7.
    for (int i = 0; i < 4; ++i) EXPECT_LT(glm::length(near_matrix[i] - far_matrix[i]), 1e-6f) << i;
}

}  // namespace
}  // namespace vellus::scene
