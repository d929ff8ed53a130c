#include "game_demo/tools/accuracy/studio.h"

#include <fmt/format.h>

#include <algorithm>

#include "game_demo/src/accuracy/groom_class.h"
#include "modules/hair/grow/grow.h"
#include "modules/hair/spawn.h"
#include "modules/light/load_environment.h"
#include "modules/scene/camera.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/view.h"

namespace vellus::demo {

namespace {

constexpr float kBallRadius = 0.095f;
constexpr glm::vec3 kBallCentre{0.0f, 1.6f, 0.0f};
constexpr float kWidest = 0.0003f;
constexpr uint32_t kMostPoints = 40;
constexpr double kYaw = 2.3;  // three quarters from behind, a little from above: all hair
constexpr double kPitch = 0.1;
constexpr double kFill = 0.95;
constexpr float kSunIrradiance = 3.0f;
constexpr glm::vec4 kSkin{0.35f, 0.22f, 0.16f, 1.0f};

std::shared_ptr<const asset::SceneAsset> ball_asset(const hair::GrowSurface& ball) {
    asset::Primitive primitive;
    primitive.positions = ball.positions;
    primitive.normals = ball.normals;
    primitive.indices = ball.triangles;
    primitive.material = 0;
    auto scene = std::make_shared<asset::SceneAsset>();
    scene->meshes = {{"ball", {primitive}, {}}};
    scene->materials = {{.name = "skin", .base_color = kSkin, .metallic = 0.0f, .roughness = 0.6f}};
    scene->nodes = {{.name = "ball", .mesh = 0}};
    scene->roots = {0};
    return scene;
}

/// Towards the sun, in the camera's axes: right, up, back.
glm::dvec3 sun_direction(const std::string& light) {
    if (light == "side") return {1.0, 0.25, 0.1};
    if (light == "back") return {-0.35, 0.5, -1.0};
    return {0.35, 0.45, 1.0};
}

void spawn_sun(World& world, const glm::dvec3& to_sun) {
    const glm::vec3 direction(glm::normalize(to_sun));
    const glm::vec3 forward(0.0f, 0.0f, 1.0f);
    const glm::quat turn = glm::normalize(
        glm::quat(1.0f + glm::dot(forward, direction), glm::cross(forward, direction)));
    world.spawn(scene::LocalTransform{.rotation = turn}, scene::WorldTransform{},
                scene::PreviousWorldTransform{},
                scene::Light{.kind = asset::LightKind::kDirectional, .intensity = kSunIrradiance});
}

Result<void> set_light(ContentHost& host, const StudioLook& look, const glm::dmat3& axes) {
    if (look.coverage) {
        const asset::ImageF white{
            .width = 4, .height = 2, .rgba = std::vector<float>(size_t{4} * 2 * 4, 1.0f)};
        return host.set_environment({.pixels = white});
    }
    const bool sky = look.light == "environment" || look.light == "outdoors";
    if (look.light != "environment") spawn_sun(host.world(), axes * sun_direction(look.light));
    if (!sky) return {};
    return host.set_environment(light::sky_environment({}));
}

}  // namespace

Result<StudioGroom> grow_studio_groom(const std::string& name, uint32_t strands, uint64_t seed) {
    const auto style = hair::grow_style(name);
    if (!style) return style.error();
    const bool fur = name == "fur";
    StudioGroom groom{.name = name, .ball = hair::sphere_surface(kBallCentre, kBallRadius, fur)};
    hair::GrowSettings settings = hair::preset(*style);
    // Hair is short enough for the ball to stay in the picture.
    if (!fur) settings.length = std::min(settings.length, 0.28f);
    const float thicker = static_cast<float>(settings.count) / static_cast<float>(strands);
    settings.width = std::min(settings.width * std::max(thicker, 1.0f), kWidest);
    settings.points = std::min(settings.points, kMostPoints);
    settings.count = strands;
    auto grown = hair::grow_groom(groom.ball, settings, static_cast<uint32_t>(seed) + 1);
    if (!grown) return grown.error();
    groom.strands = hair::prepare_strands(*grown, glm::dmat4(1.0), settings.width);
    return groom;
}

glm::vec3 studio_colour(const std::string& name) {
    const auto* found = std::ranges::find(kHairColours, name, &HairColour::name);
    return hair::melanin_color(found == kHairColours.end() ? hair::Melanin{} : found->melanin);
}

Result<Entity> set_up_studio(ContentHost& host, const AddStrands& add, const StudioGroom& groom,
                             const StudioLook& look, uint32_t size) {
    World& world = host.world();
    host.resize(size, size);
    if (!look.coverage) {
        auto ball = scene::instantiate(world, ball_asset(groom.ball));
        if (!ball) return ball.error();
        if (auto meshes = host.add_meshes(); !meshes) return meshes.error();
    }
    auto index = add(groom);
    if (!index) return index.error();

    hair::HairExtension extension;
    extension.width.tip_scale = 1.0f;  // Strands taper by themselves.
    hair::HairMaterial& material = extension.material;
    material.base_color = look.coverage ? glm::vec3(0.9f) : studio_colour(look.colour);
    material.tip_color = material.base_color;
    material.use_groom_colors = false;
    if (look.coverage) material.color_variation = 0.0f;
    const Entity hair = hair::spawn_hair(world, *index, extension, {}, kNoEntity);

    const auto& outermost = world.resource<hair::HairLibrary>().grooms[*index].outermost;
    const std::vector<glm::dvec3> points(outermost.begin(), outermost.end());
    const auto pose = scene::frame_points(points, kYaw, kPitch, 1.0, kFill);
    scene::spawn_camera(world, pose);
    if (auto lit = set_light(host, look, pose.axes); !lit) return lit.error();
    if (auto settled = host.settle(); !settled) return settled.error();
    return hair;
}

}  // namespace vellus::demo
