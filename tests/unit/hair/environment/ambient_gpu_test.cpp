#include "modules/hair/environment/ambient_depth.h"
#include "modules/light/load_environment.h"
#include "tests/support/hair_scene.h"

// When ambient depths are worked out: for grooms that are drawn with them, once.
namespace vellus::hair {
namespace {

using test::HairScene;

class AmbientTest : public test::GpuTest {};

std::vector<std::vector<glm::vec3>> fan(float right) {
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < 50; ++i) {
        const float x = right + 0.001f * static_cast<float>(i);
        strands.push_back({{x, 0.1f, -1.0f}, {x, 0.0f, -1.0f}, {x, -0.1f, -1.0f}});
    }
    return strands;
}

size_t with_depths(const World& world) {
    const auto& grooms = world.resource<HairLibrary>().grooms;
    return static_cast<size_t>(std::ranges::count_if(
        grooms, [](const LibraryGroom& groom) { return groom.strands.ambient.bytes() > 0; }));
}

TEST_F(AmbientTest, OnlyGroomsDrawnWithDepthsGetThem) {
    HairScene scene(device(), 64, 64);
    ASSERT_TRUE(light::use_sky(scene.world, device(), {}));
    const HairTechniques plain{.environment = EnvironmentTechnique::kSh};
    const Entity first = scene.add_hair(test::make_strands(fan(-0.1f), 0.001f), {}, plain);
    scene.add_hair(test::make_strands(fan(0.1f), 0.001f), {}, plain);
    // Behind the camera.
    auto hidden = fan(0.0f);
    for (auto& strand : hidden) {
        for (glm::vec3& p : strand) p.z = 2.0f;
    }
    const HairTechniques deep{.environment = EnvironmentTechnique::kShDepth};
    scene.add_hair(test::make_strands(hidden, 0.001f), {}, deep);
    scene.build();
    scene.draw();
    EXPECT_EQ(with_depths(scene.world), 0u);

    scene.world.get<HairTechniques>(first)->environment = EnvironmentTechnique::kShDepth;
    scene.draw();
    ASSERT_EQ(with_depths(scene.world), 1u);
    const auto& groom = scene.world.resource<HairLibrary>().grooms[0];
    const VkDeviceAddress made = groom.strands.ambient.address();
    EXPECT_EQ(groom.strands.ambient.bytes(), 150u * sizeof(glm::uvec2));
    scene.draw();
    EXPECT_EQ(groom.strands.ambient.address(), made);
    EXPECT_EQ(with_depths(scene.world), 1u);
}

}  // namespace
}  // namespace vellus::hair
