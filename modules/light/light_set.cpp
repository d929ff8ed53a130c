#include "modules/light/light_set.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/frame_graph/context.h"

namespace vellus::light {

namespace {

constexpr float kSpotNear = 0.05f;

/// Any two unit axes across `axis`, continuous but at -Y.
glm::dmat3 axes_along(const glm::dvec3& axis) {
    const glm::dvec3 helper = std::abs(axis.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(helper, axis));
    return {right, glm::cross(axis, right), axis};
}

struct Sphere {
    glm::dvec3 center{0.0};
    double radius = 1.0;
};

Sphere sphere_around(const scene::Box& box) {
    if (box.empty()) return {};
    return {box.center(), std::max(0.5 * glm::length(box.max - box.min), 1e-3)};
}

/// Orthographic view along the sun's beam around `focus`, its centre on whole texels so that
/// shadows do not crawl when the groom moves; depth reaches over everything that may cast.
void fit_sun(const Sphere& focus, const Sphere& all, uint32_t size, PunctualLight& light,
             glm::dmat4& world_to_shadow, float& pixels_per_metre) {
    const glm::dmat3 axes = axes_along(glm::dvec3(light.to_light));
    // A radius in steps of an eighth keeps the texel size while the groom breathes.
    const double radius = std::exp2(std::ceil(8.0 * std::log2(focus.radius * 1.02)) / 8.0);
    const double texel = 2.0 * radius / size;
    glm::dvec3 center = glm::transpose(axes) * focus.center;
    center.x = std::floor(center.x / texel) * texel;
    center.y = std::floor(center.y / texel) * texel;
    const double reach = glm::distance(focus.center, all.center) + all.radius + radius;

    glm::dmat4 to_light(glm::transpose(axes));
    to_light[3] = glm::dvec4(-center, 1.0);
    glm::dmat4 ortho(1.0);
    ortho[0][0] = ortho[1][1] = 1.0 / radius;
    // Along +Z towards the light: reach above the centre is depth 1, reach below it is 0.
    ortho[2][2] = 0.5 / reach;
    ortho[3][2] = 0.5;
    world_to_shadow = ortho * to_light;
    light.shadow_texel = static_cast<float>(texel);
    light.shadow_depth = static_cast<float>(2.0 * reach);
    pixels_per_metre = static_cast<float>(1.0 / texel);
}

void fit_spot(const scene::Light& source, const glm::dvec3& position, const glm::dvec3& to_light,
              uint32_t size, PunctualLight& light, glm::dmat4& world_to_shadow,
              float& pixels_per_metre) {
    const double fov = std::clamp(2.0 * source.outer_cone, 0.02, 2.8);
    const glm::dmat3 axes = axes_along(to_light);
    glm::dmat4 view(glm::transpose(axes));
    view[3] = glm::dvec4(-(glm::transpose(axes) * position), 1.0);
    world_to_shadow = scene::projection(static_cast<float>(fov), 1.0, kSpotNear) * view;
    const double half = std::tan(0.5 * fov);
    light.shadow_texel = static_cast<float>(2.0 * half / size);
    light.shadow_depth = kSpotNear;
    pixels_per_metre = static_cast<float>(0.5 * size / half);
}

float strength(const scene::Light& light) {
    return light.intensity * std::max({light.color.r, light.color.g, light.color.b});
}

PunctualLight describe(const scene::Light& source, const glm::dvec3& position,
                       const glm::dvec3& to_light, const glm::dvec3& camera) {
    PunctualLight light;
    light.kind =
        source.kind == asset::LightKind::kDirectional ? PunctualKind::kSun : PunctualKind::kSpot;
    light.position = glm::vec3(position - camera);
    light.to_light = glm::vec3(to_light);
    light.color = glm::max(source.color * source.intensity, glm::vec3(0.0f));
    if (source.kind == asset::LightKind::kSpot) {
        // KHR_lights_punctual, "Inner and Outer Cone Angles".
        const float outer = std::cos(source.outer_cone);
        const float inner = std::cos(std::min(source.inner_cone, source.outer_cone));
        light.cone_scale = 1.0f / std::max(inner - outer, 1e-3f);
        light.cone_offset = -outer * light.cone_scale;
    }
    return light;
}

}  // namespace

void gather_lights(Query<const scene::MeshInstance> meshes,
                   Query<const scene::Light, const scene::WorldTransform> lights,
                   Query<const scene::WorldBounds, const ShadowFocus*> bounds,
                   Res<const scene::ViewState> view, Res<const ShadowSettings> settings,
                   Res<LightSet> set) {
    scene::Box focus_box;
    scene::Box all_box;
    bounds.each([&](const scene::WorldBounds& item, const ShadowFocus* focus) {
        all_box.include(item.box);
        if (focus) focus_box.include(item.box);
    });
    const Sphere all = sphere_around(all_box);
    const Sphere focus = focus_box.empty() ? all : sphere_around(focus_box);

    LightBlock& block = set->block;
    const auto environment = block.environment;
    block = {};
    block.environment = environment;
    block.opaque_casters = static_cast<uint32_t>(meshes.count());
    set->left_out = 0;
    std::array<float, kMaxLights> strengths{};
    const glm::dvec3 camera = view->pose.position;
    glm::dmat4 from_camera(1.0);
    from_camera[3] = glm::dvec4(camera, 1.0);

    lights.each([&](const scene::Light& source, const scene::WorldTransform& world) {
        const float power = strength(source);
        if (!(power > 0.0f)) return;
        uint32_t slot = block.count;
        if (slot == kMaxLights) {
            ++set->left_out;
            slot = static_cast<uint32_t>(std::ranges::min_element(strengths) - strengths.begin());
            if (strengths[slot] >= power) return;
        } else {
            ++block.count;
        }
        strengths[slot] = power;
        const glm::dvec3 position(world.matrix[3]);
        const glm::dvec3 to_light = glm::normalize(glm::dvec3(world.matrix[2]));
        PunctualLight light = describe(source, position, to_light, camera);
        glm::dmat4& world_to_shadow = set->world_to_shadow[slot];
        float& pixels = set->shadow_pixels_per_metre[slot];
        if (settings->size > 0 && source.kind != asset::LightKind::kPoint) {
            light.shadow_size = settings->size;
            light.shadow_tile = 0;
            if (light.kind == PunctualKind::kSun) {
                fit_sun(focus, all, settings->size, light, world_to_shadow, pixels);
            } else {
                fit_spot(source, position, to_light, settings->size, light, world_to_shadow,
                         pixels);
            }
            light.to_shadow = glm::mat4(world_to_shadow * from_camera);
        }
        block.light[slot] = light;
    });
    for (uint32_t slot = 0; slot < block.count; ++slot) {
        if (block.light[slot].shadow_tile != kNoShadow)
            block.light[slot].shadow_tile = block.tiles++;
    }
}

void describe_shadow_atlas(Res<const LightSet> set, Res<const ShadowSettings> settings,
                           Res<scene::RenderFrame> frame) {
    const bool used = set->block.tiles > 0 && set->block.opaque_casters > 0;
    const graph::ImageDesc desc{scene::kDepthFormat, used ? settings->size * set->block.tiles : 1,
                                used ? settings->size : 1};
    frame->opaque_shadows = frame->graph.create_image("opaque shadows", desc);
    auto pass = frame->graph.add_pass("light/shadow_atlas", graph::PassKind::kRaster);
    frame->opaque_shadows = pass.depth(frame->opaque_shadows, graph::clear(0.0f));
    pass.execute([](graph::PassContext&) {});
}

void upload_lights(Res<const LightSet> set, Res<scene::RenderFrame> frame) {
    frame->lights_block = frame->uploads.push_uniform(set->block);
    frame->lights = frame->uploads.address(frame->lights_block);
}

}  // namespace vellus::light
