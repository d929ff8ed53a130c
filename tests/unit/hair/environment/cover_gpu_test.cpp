#include <random>

#include "modules/character/mesh_library.h"
#include "modules/character/register.h"
#include "modules/hair/environment/cover.h"
#include "modules/hair/environment/cover_meshes.h"
#include "modules/hair/environment/mesh_cover.h"
#include "modules/light/light_glsl.h"
#include "modules/light/load_environment.h"
#include "modules/scene/instantiate.h"
#include "tests/support/hair_scene.h"
#include "tests/support/one_mesh_scene.h"

// A floor below a slab of dense hair, the camera between the two, under nothing but a sky.
namespace vellus::hair {
namespace {

namespace pbr {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/pbr.glsl"
}  // namespace pbr

using test::HairScene;

constexpr uint32_t kWidth = 160;
constexpr uint32_t kHeight = 120;
constexpr float kFloor = -0.05f;
constexpr float kStep = 0.025f;  // between the floor's vertices
constexpr float kStrand = 0.001f;
const double kFocal = 0.5 * kHeight / std::tan(0.4);  // pixels

/// A grid of 4 x 4 m at kFloor, facing up.
std::shared_ptr<asset::SceneAsset> floor_scene() {
    asset::Primitive p;
    constexpr uint32_t kSide = 161;
    for (uint32_t z = 0; z < kSide; ++z) {
        for (uint32_t x = 0; x < kSide; ++x) {
            p.positions.emplace_back(kStep * static_cast<float>(x) - 2.0f, kFloor,
                                     kStep * static_cast<float>(z) - 3.5f);
            p.normals.emplace_back(0, 1, 0);
            if (x == 0 || z == 0) continue;
            const uint32_t at = z * kSide + x;
            const uint32_t before = at - kSide;
            p.indices.insert(p.indices.end(), {before - 1, at - 1, at, before - 1, at, before});
        }
    }
    return test::one_mesh_scene("floor", std::move(p));
}

/// Strands along x, 10 to 20 cm above the camera's height.
StrandData slab() {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < 3'000; ++i) {
        const glm::vec3 root(-0.3f, 0.1f + 0.1f * unit(random), -0.9f + 0.6f * unit(random));
        strands.push_back({root, root + glm::vec3(0.3f, 0, 0), root + glm::vec3(0.6f, 0, 0)});
    }
    return test::make_strands(strands, kStrand);
}

class CoverTest : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        scene_.emplace(device(), kWidth, kHeight);
        character::register_character(world(), scene_->schedule);
        character::register_character_passes(world(), scene_->schedule);
        ASSERT_TRUE(light::use_sky(world(), device(), {}));
        scene_->build();
    }
    void TearDown() override {
        scene_.reset();
        GpuTest::TearDown();
    }
    World& world() { return scene_->world; }

    /// The floor as an instance of its own, and its mesh.
    Entity place_floor(const scene::LocalTransform& at = {}) {
        const auto index = scene::instantiate(world(), floor_, at);
        EXPECT_TRUE(index);
        auto& library = world().resource<scene::SceneLibrary>();
        EXPECT_TRUE(world().resource<character::MeshLibrary>().update(device(), library));
        root_ = library.instances[*index].root;
        return library.instances[*index].nodes[0];
    }
    Entity add_slab(Entity parent, const glm::vec3& color,
                    EnvironmentTechnique environment = EnvironmentTechnique::kShDepth) {
        HairExtension look;
        look.material.base_color = look.material.tip_color = color;
        look.width.tip_scale = 1.0f;
        auto groom = find_groom(world(), "slab");
        if (!groom) groom = *add_strands(world(), device(), "slab", slab(), {});
        return spawn_hair(world(), *groom, look, {.environment = environment}, parent);
    }
    /// The pixel that shows the floor at (x, z).
    static glm::uvec2 pixel_of(double x, double z) {
        return {0.5 * kWidth + kFocal * x / -z,
                0.5 * kHeight - kFocal * static_cast<double>(kFloor) / -z};
    }
    /// What its middle shows.
    static glm::vec3 shown_near(double x, double z) {
        const glm::dvec2 pixel = glm::dvec2(pixel_of(x, z)) + 0.5;
        const glm::dvec3 ray((pixel.x - 0.5 * kWidth) / kFocal, (0.5 * kHeight - pixel.y) / kFocal,
                             -1.0);
        return ray * (static_cast<double>(kFloor) / ray.y);
    }
    static glm::vec3 floor_at(const std::vector<glm::vec4>& picture, double x, double z) {
        const glm::uvec2 pixel = pixel_of(x, z);
        return glm::vec3(picture[pixel.y * kWidth + pixel.x]);
    }
    /// By hand, of the floor at `p` whose cover is `sky`.
    glm::vec3 expected(const glm::vec3& p, const SkyAtVertex& sky,
                       const character::SkyCover& cover) {
        const asset::Material& m = floor_->materials[0];
        const pbr::PbrSurface surface{glm::vec3(m.base_color), m.metallic, m.roughness};
        const glm::vec3 n(0, 1, 0);
        const glm::vec3 to_view = glm::normalize(-p);
        light::glsl::Sh9 sh;
        std::ranges::copy(world().resource<light::LightSet>().block.environment, sh.c);
        const auto all = pbr::pbr_environment(
            surface, glm::dot(n, to_view),
            light::glsl::sh_irradiance_over_pi(sh, glm::normalize(n + sky.lean)),
            light::glsl::sh_irradiance_over_pi(sh, glm::reflect(-to_view, n)));
        return all * glsl::cover_share(sky.open, cover.thickness * sky.depth, cover.forward,
                                       cover.backward);
    }
    SkyAtVertex sky_at(const glm::vec3& p) {
        const StrandData strands = slab();
        std::vector<CoveringGroom> grooms = {
            {ambient_volume({strands.positions, strands.strand_begin}, StrandTaper{kStrand}),
             glm::mat4(1.0f)}};
        const std::vector<glm::vec3> at = {p};
        const std::vector<glm::vec3> up = {{0, 1, 0}};
        return mesh_cover({at, up, {}}, grooms).vertices[0];
    }

    std::shared_ptr<asset::SceneAsset> floor_ = floor_scene();
    std::optional<HairScene> scene_;
    Entity root_;
};

void expect_near(const glm::vec3& value, const glm::vec3& by_hand) {
    // Vertices hold bytes, and what lies between is theirs, blended.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], by_hand[i], 0.03f * by_hand[i]) << i;
}

constexpr glm::vec3 kBlack(0.0005f);
constexpr glm::vec3 kWhite(0.99f);

TEST_F(CoverTest, AFloorUnderDenseHairIsDarkAndAsBrightFarAway) {
    const Entity floor = place_floor();
    const auto bare = scene_->draw();
    add_slab(root_, kBlack);
    scene_->draw();
    const auto covered = scene_->draw();
    const auto* cover = world().get<character::SkyCover>(floor);
    ASSERT_NE(cover, nullptr);
    const glm::vec3 below = shown_near(0.0, -0.6);
    const glm::vec3 beside = shown_near(0.4, -0.8);
    EXPECT_LT(floor_at(covered, 0.0, -0.6).x, 0.4f * floor_at(bare, 0.0, -0.6).x);
    expect_near(floor_at(covered, 0.0, -0.6), expected(below, sky_at(below), *cover));
    expect_near(floor_at(covered, 0.4, -0.8), expected(beside, sky_at(beside), *cover));
    expect_near(floor_at(bare, 0.4, -0.8), expected(beside, {}, *cover));
    EXPECT_LT(floor_at(covered, 0.4, -0.8).x, 0.95f * floor_at(bare, 0.4, -0.8).x);
    // Far away to the bit.
    EXPECT_EQ(floor_at(covered, 1.7, -3.2), floor_at(bare, 1.7, -3.2));
}

TEST_F(CoverTest, LightHairLetsMoreThrough) {
    const Entity floor = place_floor();
    const glm::vec3 bare = floor_at(scene_->draw(), 0.4, -0.8);
    const Entity hair = add_slab(root_, kBlack);
    scene_->draw();
    const float black = floor_at(scene_->draw(), 0.0, -0.6).x;
    auto* material = world().get<HairMaterial>(hair);
    material->base_color = material->tip_color = kWhite;
    const auto picture = scene_->draw();
    const auto* cover = world().get<character::SkyCover>(floor);
    ASSERT_NE(cover, nullptr);
    EXPECT_GT(floor_at(picture, 0.0, -0.6).x, 1.5f * black);
    EXPECT_GT(cover->forward.x + cover->backward.x, 0.9f);
    const glm::vec3 below = shown_near(0.0, -0.6);
    expect_near(floor_at(picture, 0.0, -0.6), expected(below, sky_at(below), *cover));
    // Half as many fibres.
    material->alpha = 0.5f;
    scene_->draw();
    EXPECT_FLOAT_EQ(world().get<character::SkyCover>(floor)->thickness, 0.5f);
    // And none, as if there had never been any.
    material->alpha = 0.0f;
    EXPECT_EQ(floor_at(scene_->draw(), 0.4, -0.8), bare);
}

TEST_F(CoverTest, TheCoverTurnsWithItsMesh) {
    // Both turned by a quarter, then the slab lies where it was, and the floor's front has it
    // behind.
    const glm::quat turn = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 1, 0));
    const glm::vec3 middle(0.0f, 0.0f, -0.6f);
    const Entity floor = place_floor({glm::dvec3(middle - turn * middle), turn});
    add_slab(root_, kBlack);
    scene_->draw();
    const auto picture = scene_->draw();
    const auto* cover = world().get<character::SkyCover>(floor);
    ASSERT_NE(cover, nullptr);
    // Near the slab's rim, in its own space and as it is seen.
    const glm::vec3 seen = shown_near(0.0, -0.85);
    const glm::vec3 own = glm::inverse(turn) * (seen - middle) + middle;
    SkyAtVertex sky = sky_at(own);
    ASSERT_GT(glm::length(sky.lean), 0.2f);
    sky.lean = turn * sky.lean;
    expect_near(floor_at(picture, 0.0, -0.85), expected(seen, sky, *cover));
}

TEST_F(CoverTest, OnlyWhatHairCoversPays) {
    const Entity floor = place_floor();
    add_slab(root_, kBlack, EnvironmentTechnique::kSh);  // knows no depths
    add_slab(kNoEntity, kBlack);                         // of no scene: moves as it likes
    const Entity other = place_floor({glm::dvec3(0, -9, 0)});
    scene_->draw();
    scene_->draw();
    EXPECT_EQ(world().get<character::SkyCover>(floor), nullptr);
    EXPECT_EQ(world().get<character::SkyCover>(other), nullptr);
    EXPECT_TRUE(world().resource<HairCovers>().covers.empty());
    EXPECT_EQ(world().resource<character::MeshLibrary>().pipelines.skin_covered, nullptr);
}

TEST_F(CoverTest, IsWorkedOutOnceAndShared) {
    const Entity first = place_floor();
    add_slab(root_, kBlack);
    const Entity second = place_floor();
    add_slab(root_, kWhite);
    for (int frame = 0; frame < 4; ++frame) scene_->draw();
    const auto& covers = world().resource<HairCovers>();
    EXPECT_EQ(covers.covers.size(), 1u);
    EXPECT_EQ(covers.meshes.size(), 2u);
    const auto* a = world().get<character::SkyCover>(first);
    const auto* b = world().get<character::SkyCover>(second);
    ASSERT_TRUE(a != nullptr && b != nullptr);
    EXPECT_EQ(a->vertices, b->vertices);
    EXPECT_LT(a->forward.x, b->forward.x) << "each has the colour of its own hair";
    for (const LibraryGroom& groom : world().resource<HairLibrary>().grooms) {
        EXPECT_EQ(groom.volume, nullptr) << "no memory held for what is done";
    }
}

}  // namespace
}  // namespace vellus::hair
