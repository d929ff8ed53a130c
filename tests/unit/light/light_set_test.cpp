#include "modules/light/light_set.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "engine/ecs/schedule.h"

namespace vellus::light {
namespace {

/// A sun over a tuft of hair (radius 0.1 m) on a figure (radius 1 m), which stands on a wide
/// ground.
class LightSetTest : public testing::Test {
  protected:
    LightSetTest() {
        world_.insert_resource(scene::ViewState{});
        world_.insert_resource(scene::ViewSettings{});
        world_.insert_resource(ShadowSettings{});
        world_.insert_resource(LightSet{});
        // Shines along -Z of its transform: from above and aside.
        glm::dmat4 turned(1.0);
        const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.5, 0.8, 0.2));
        turned[2] = glm::dvec4(to_sun, 0.0);
        world_.spawn(scene::Light{.kind = asset::LightKind::kDirectional},
                     scene::WorldTransform{turned});
        add({0.0, 1.7, 0.0}, 0.1, ShadowFocus{.hair = true});
        add({0.0, 0.9, 0.0}, 1.0, ShadowFocus{});
        scene::WorldBounds ground;
        ground.box.include(glm::dvec3(-50.0, -0.1, -50.0));
        ground.box.include(glm::dvec3(50.0, 0.0, 50.0));
        world_.spawn(ground);
        schedule_.add(gather_lights);
        EXPECT_TRUE(schedule_.build(world_));
    }
    void add(const glm::dvec3& center, double radius, ShadowFocus focus) {
        scene::WorldBounds bounds;
        const glm::dvec3 half(radius / std::sqrt(3.0));
        bounds.box.include(center - half);
        bounds.box.include(center + half);
        world_.spawn(bounds, focus);
    }
    const LightSet& from(double distance, uint32_t height) {
        auto& view = world_.resource<scene::ViewState>();
        view.pose = {.position = {0.0, 1.7, distance}, .vertical_fov = 0.6f};
        world_.resource<scene::ViewSettings>().size = {2 * height, height};
        schedule_.run(world_);
        return world_.resource<LightSet>();
    }
    /// Where a world position falls in a map: xy in [-1, 1] inside.
    static glm::dvec3 in_map(const glm::mat4& to_map, const glm::dvec3& camera,
                             const glm::dvec3& point) {
        return glm::dmat4(to_map) * glm::dvec4(point - camera, 1.0);
    }

    World world_;
    Schedule schedule_{"lights"};
};

TEST_F(LightSetTest, HairHasAFinerMapThanTheFigureAndBothHoldTheirOwn) {
    const LightSet& set = from(3.0, 720);
    const PunctualLight& sun = set.block.light[0];
    ASSERT_EQ(set.block.count, 1u);
    EXPECT_LT(sun.hair_texel * sun.hair_size, 0.25f) << "the tuft is 0.2 m wide";
    EXPECT_GE(sun.hair_texel * sun.hair_size, 0.2f);
    EXPECT_GT(sun.opaque_texel * sun.opaque_size, 2.0f);
    EXPECT_LT(sun.opaque_texel * sun.opaque_size, 2.6f) << "not the ground's hundred metres";
    const glm::dvec3 camera{0.0, 1.7, 3.0};
    for (const double y : {0.0, 0.9, 1.7}) {
        const glm::dvec3 at = in_map(sun.to_opaque, camera, {0.0, y, 0.0});
        EXPECT_LT(std::max(std::abs(at.x), std::abs(at.y)), 1.0) << y;
        EXPECT_GT(at.z, 0.0);
        EXPECT_LT(at.z, 1.0);
    }
    const glm::dvec3 tuft = in_map(sun.to_hair, camera, {0.0, 1.7, 0.0});
    EXPECT_NEAR(tuft.x, 0.0, 2.0 / sun.hair_size + 1e-6) << "centred, but for whole texels";
    EXPECT_NEAR(tuft.y, 0.0, 2.0 / sun.hair_size + 1e-6);
}

TEST_F(LightSetTest, ATexelIsAboutAPixelAndNeverHalfAsWide) {
    for (const uint32_t height : {180u, 360u, 720u}) {
        for (const double distance : {1.0, 2.5, 6.0}) {
            world_.resource<LightSet>().hair_size = 0;
            const LightSet& set = from(distance, height);
            const double pixels = 0.1 * height / (distance * std::tan(0.3));
            EXPECT_TRUE(std::has_single_bit(set.hair_size));
            EXPECT_GE(set.hair_size, std::min(pixels, 1024.0)) << height << ' ' << distance;
            EXPECT_LT(set.hair_size, std::max(2.0 * pixels, 33.0)) << height << ' ' << distance;
        }
    }
}

TEST_F(LightSetTest, ASlowRetreatChangesTheMapOnceNotBackAndForth) {
    uint32_t changes = 0;
    uint32_t last = from(1.0, 720).hair_size;
    for (int step = 0; step <= 200; ++step) {
        // To and fro by one percent around a distance that grows from 1 to 1.9 m.
        const double distance = (1.0 + 0.0045 * step) * (step % 2 == 0 ? 1.01 : 0.99);
        const uint32_t size = from(distance, 720).hair_size;
        if (size != last) ++changes;
        last = size;
    }
    EXPECT_LE(changes, 1u);
}

TEST_F(LightSetTest, TheLargestMapIsWhatTheSettingsSay) {
    EXPECT_EQ(from(0.05, 720).hair_size, 1024u) << "inside the hair";
    world_.resource<ShadowSettings>().size = 256;
    EXPECT_EQ(from(0.4, 720).hair_size, 256u);
    world_.resource<ShadowSettings>() = {.size = 512, .fit_to_picture = false};
    EXPECT_EQ(from(40.0, 90).hair_size, 512u);
}

}  // namespace
}  // namespace vellus::light
