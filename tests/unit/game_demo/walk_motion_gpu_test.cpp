#include <glm/gtc/packing.hpp>

#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "modules/hair/binding/deform_passes.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/components.h"
#include "tests/support/gpu_fixture.h"

// The project's own walking figure with moving hair, as the demo draws it.
namespace vellus::demo {
namespace {

using WalkMotion = test::GpuTest;

/// Colliders a little inside the figure's skin, where the scene brings none.
void add_colliders(World& world) {
    if (world.query<const hair::HairCollider>().count() > 0) return;
    std::vector<std::pair<Entity, hair::HairCollider>> made;
    world.query<Entity, const scene::Name>().each([&](Entity entity, const scene::Name& name) {
        if (name.value == "head") made.push_back({entity, {{0, 0.1f, 0}, {0, 0.12f, 0}, 0.08f}});
        if (name.value == "chest") made.push_back({entity, {{0, 0, 0}, {0, 0.1f, 0}, 0.09f}});
    });
    for (const auto& [entity, collider] : made) world.add(entity, collider);
}

TEST_F(WalkMotion, StrandsKeepTheirLengthsInEveryFrame) {
    auto renderer = Renderer::create(device(), {});
    ASSERT_TRUE(renderer) << renderer.error().message();
    Options options;
    options.scene = VELLUS_SOURCE_DIR "/assets/scenes/walk.gltf";
    options.size = {64, 64};
    ASSERT_TRUE(load_content(**renderer, options));
    World& world = (*renderer)->world();
    add_colliders(world);
    std::vector<Entity> worn;
    world.query<Entity, const hair::Hair>().each(
        [&](Entity entity, const hair::Hair&) { worn.push_back(entity); });
    ASSERT_FALSE(worn.empty());
    const Entity person = worn.front();
    ASSERT_TRUE(hair::add_motion(world, device(), person, {.smallest_pixels = 0.0f}));
    const auto& groom =
        world.resource<hair::HairLibrary>().grooms[world.get<hair::Hair>(person)->groom];

    double worst = 0.0;
    double swung = 0.0;
    std::vector<glm::vec3> points(groom.positions.size());
    for (int frame = 0; frame < 72; ++frame) {
        ASSERT_TRUE((*renderer)->draw(Output::kNowhere));
        ASSERT_TRUE((*renderer)->wait());
        const auto& deforms = world.resource<hair::HairFrame>().deforms;
        if (deforms.empty()) continue;
        ASSERT_EQ(deforms[0].entity, person);
        const auto& buffer = world.resource<hair::HairDeformation>().points;
        ASSERT_TRUE(buffer.read_back(device(), std::as_writable_bytes(std::span(points))));
        const glm::dmat4 node(glm::mat4(deforms[0].node));
        for (size_t s = 0; s + 1 < groom.strand_begin.size(); ++s) {
            for (uint32_t i = groom.strand_begin[s] + 1; i < groom.strand_begin[s + 1]; ++i) {
                const glm::dvec3 a = node * glm::dvec4(glm::dvec3(groom.positions[i - 1]), 1.0);
                const glm::dvec3 b = node * glm::dvec4(glm::dvec3(groom.positions[i]), 1.0);
                const double now = glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1]));
                ASSERT_TRUE(std::isfinite(now));
                worst = std::max(worst, std::abs(now / glm::distance(a, b) - 1.0));
                swung = std::max(swung, glm::distance(glm::dvec3(points[i]), b));
            }
        }
    }
    // Positions are floats of up to a metre; the shortest segments are some millimetres long.
    EXPECT_LT(worst, 1e-3);
    EXPECT_GT(swung, 0.005) << "hair that does not swing proves nothing";
    RecordProperty("worst_length_error", std::to_string(worst));
}

}  // namespace
}  // namespace vellus::demo
