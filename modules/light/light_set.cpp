#include "modules/light/light_set.h"

#include <algorithm>
#include <bit>
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

/// How one shadow map sees the world.
struct ShadowView {
    glm::dmat4 world_to_map{1.0};
    float texel = 0.0f;  ///< metres: everywhere (sun), at 1 m (spot)
    float range = 0.0f;  ///< metres: of reversed depth (sun), near plane (spot)
};

/// Orthographic view along the sun's beam around `focus`, its centre on whole texels from
/// `grid_origin` so that shadows do not crawl when the groom moves; depth reaches over everything
/// that may cast.
ShadowView fit_sun(const Sphere& focus, const Sphere& all, uint32_t size, const glm::dvec3& to_sun,
                   const glm::dvec3& grid_origin) {
    const glm::dmat3 axes = axes_along(to_sun);
    // A radius in steps of an eighth keeps the texel size while the groom breathes.
    const double radius = std::exp2(std::ceil(8.0 * std::log2(focus.radius * 1.02)) / 8.0);
    const double texel = 2.0 * radius / size;
    glm::dvec3 center = glm::transpose(axes) * (focus.center - grid_origin);
    center.x = std::floor(center.x / texel) * texel;
    center.y = std::floor(center.y / texel) * texel;
    center += glm::transpose(axes) * grid_origin;
    const double reach = glm::distance(focus.center, all.center) + all.radius + radius;

    glm::dmat4 to_light(glm::transpose(axes));
    to_light[3] = glm::dvec4(-center, 1.0);
    glm::dmat4 ortho(1.0);
    ortho[0][0] = ortho[1][1] = 1.0 / radius;
    // Along +Z towards the light: reach above the centre is depth 1, reach below it is 0.
    ortho[2][2] = 0.5 / reach;
    ortho[3][2] = 0.5;
    return {ortho * to_light, static_cast<float>(texel), static_cast<float>(2.0 * reach)};
}

ShadowView fit_spot(const scene::Light& source, const glm::dvec3& position,
                    const glm::dvec3& to_light, uint32_t size) {
    const double fov = std::clamp(2.0 * source.outer_cone, 0.02, 2.8);
    const glm::dmat3 axes = axes_along(to_light);
    glm::dmat4 view(glm::transpose(axes));
    view[3] = glm::dvec4(-(glm::transpose(axes) * position), 1.0);
    return {scene::projection(static_cast<float>(fov), 1.0, kSpotNear) * view,
            static_cast<float>(2.0 * std::tan(0.5 * fov) / size), kSpotNear};
}

/// The side of a map whose texels are about pixels where `focus` is seen: the next power of two,
/// not above `settings.size`. `now`, this frame's side so far, is kept while it is not far off, so
/// that a slow approach does not make it change back and forth.
uint32_t map_size(const Sphere& focus, const scene::CameraPose& camera, double picture_height,
                  const ShadowSettings& settings, uint32_t now) {
    if (!settings.fit_to_picture || settings.size == 0) return settings.size;
    const double distance = glm::distance(camera.position, focus.center);
    if (distance <= focus.radius) return settings.size;
    const double pixels =
        focus.radius * picture_height / (distance * std::tan(0.5 * camera.vertical_fov));
    const auto fits = [&](double size) { return size >= pixels && size <= 2.5 * pixels; };
    if (now != 0 && now <= settings.size && fits(now)) return now;
    const auto wanted = static_cast<uint32_t>(std::clamp(pixels, 32.0, 65536.0));
    return std::min(std::bit_ceil(wanted), settings.size);
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

float strength(const scene::Light& light) {
    const float brightest = std::max({light.color.r, light.color.g, light.color.b});
    return light.intensity > 0.0f && brightest > 0.0f ? light.intensity * brightest : 0.0f;
}

void gather_lights(Query<const scene::MeshInstance> meshes,
                   Query<const scene::Light, const scene::WorldTransform> lights,
                   Query<const scene::WorldBounds, const ShadowFocus*> bounds,
                   Res<const scene::ViewState> view, Res<const scene::ViewSettings> picture,
                   Res<const ShadowSettings> settings, Res<LightSet> set) {
    scene::Box hair_box;
    scene::Box focus_box;
    scene::Box all_box;
    bounds.each([&](const scene::WorldBounds& item, const ShadowFocus* focus) {
        all_box.include(item.box);
        if (focus) focus_box.include(item.box);
        if (focus && focus->hair) hair_box.include(item.box);
    });
    const Sphere all = sphere_around(all_box);
    const Sphere focus = focus_box.empty() ? all : sphere_around(focus_box);
    const Sphere hair = hair_box.empty() ? focus : sphere_around(hair_box);
    // Texels are counted from where the scene first was, so that a scene elsewhere has the same
    // ones.
    if (!set->grid_origin && !all_box.empty()) set->grid_origin = all.center;
    const glm::dvec3 grid_origin = set->grid_origin.value_or(glm::dvec3(0.0));
    const double height = picture->size.y;
    set->hair_size = map_size(hair, view->pose, height, *settings, set->hair_size);
    set->opaque_size = map_size(focus, view->pose, height, *settings, set->opaque_size);

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
        if (settings->size > 0 && source.kind != asset::LightKind::kPoint) {
            light.shadow_tile = 0;
            const auto fit = [&](const Sphere& sphere, uint32_t size) {
                return light.kind == PunctualKind::kSun
                           ? fit_sun(sphere, all, size, to_light, grid_origin)
                           : fit_spot(source, position, to_light, size);
            };
            const ShadowView of_hair = fit(hair, set->hair_size);
            set->world_to_hair[slot] = of_hair.world_to_map;
            set->hair_texels_per_metre[slot] = 1.0f / of_hair.texel;
            light.to_hair = glm::mat4(of_hair.world_to_map * from_camera);
            light.hair_texel = of_hair.texel;
            light.hair_range = of_hair.range;
            light.hair_size = set->hair_size;
            const ShadowView of_opaque = fit(focus, set->opaque_size);
            light.to_opaque = glm::mat4(of_opaque.world_to_map * from_camera);
            light.opaque_texel = of_opaque.texel;
            light.opaque_range = of_opaque.range;
            light.opaque_size = set->opaque_size;
        }
        block.light[slot] = light;
    });
    for (uint32_t slot = 0; slot < block.count; ++slot) {
        if (block.light[slot].shadow_tile != kNoShadow)
            block.light[slot].shadow_tile = block.tiles++;
    }
}

void describe_shadow_atlas(Res<const LightSet> set, Res<scene::RenderFrame> frame) {
    const bool used = set->block.tiles > 0 && set->block.opaque_casters > 0;
    const graph::ImageDesc desc{scene::kDepthFormat, used ? set->opaque_size * set->block.tiles : 1,
                                used ? set->opaque_size : 1};
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
