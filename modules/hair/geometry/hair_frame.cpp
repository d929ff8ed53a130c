#include "modules/hair/geometry/hair_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "modules/hair/geometry/groom_colors.h"
#include "modules/light/light_glsl.h"

namespace vellus::hair {

namespace {

/// Pixels that the box may touch; all where it reaches behind the camera.
scene::PixelRect pixels_of(const scene::Box& box, const scene::ViewState& view) {
    const glm::vec2 size(view.view.size);
    glm::vec2 low(size);
    glm::vec2 high(0.0f);
    for (const glm::dvec3& corner : box.corners()) {
        const glm::vec4 clip = view.view.view_projection * glm::vec4(view.relative(corner), 1.0f);
        if (clip.w <= view.view.near_plane) return {glm::ivec2(0), glm::ivec2(view.view.size)};
        const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * size;
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    // A strand at the edge of the box is up to half its width and a pixel outside.
    low = glm::clamp(low - 2.0f, glm::vec2(0.0f), size);
    high = glm::clamp(high + 2.0f, glm::vec2(0.0f), size);
    return {glm::ivec2(low), glm::ivec2(glm::ceil(high))};
}

HairEffects plan(const Hair& hair, const LibraryGroom& groom, const HairMaterial& material,
                 const HairTechniques& chosen, bool visible, const light::LightBlock& lights) {
    HairEffects effects{.groom = hair.groom, .techniques = chosen};
    const bool any_strands = groom.strands.segment_count > 0 || groom.cards;
    if (!any_strands || material.alpha <= 0.0f || !visible) {
        effects.drawn = false;
        effects.opacity = !any_strands             ? EffectReason::kNoStrands
                          : material.alpha <= 0.0f ? EffectReason::kTransparent
                                                   : EffectReason::kOutOfView;
        effects.scattering = effects.multiple = effects.environment = effects.opacity;
        effects.techniques.multiple = MultipleTechnique::kNone;
        effects.techniques.environment = EnvironmentTechnique::kNone;
    }
    if (lights.tiles == 0 && chosen.shadow != ShadowTechnique::kNone) {
        effects.techniques.shadow = ShadowTechnique::kNone;
        effects.shadow = EffectReason::kNoShadowingLight;
    }
    if (!any_strands || material.alpha <= 0.0f) {
        effects.techniques.shadow = ShadowTechnique::kNone;
        effects.shadow = effects.opacity;
    }
    if (!effects.drawn) return effects;
    if (material.scatter <= 0.0f && chosen.multiple != MultipleTechnique::kNone) {
        effects.techniques.multiple = MultipleTechnique::kNone;
        effects.multiple = EffectReason::kNoScatter;
    }
    const bool dark = std::ranges::all_of(lights.environment,
                                          [](const glm::vec3& c) { return c == glm::vec3(0.0f); });
    if (dark && chosen.environment != EnvironmentTechnique::kNone) {
        effects.techniques.environment = EnvironmentTechnique::kNone;
        effects.environment = EffectReason::kNoEnvironment;
    }
    return effects;
}

glm::mat4 affine(const glm::dmat4& world, const glm::dvec3& camera) {
    const glm::mat4x3 m = scene::relative_affine(world, camera);
    return {glm::vec4(m[0], 0.0f), glm::vec4(m[1], 0.0f), glm::vec4(m[2], 0.0f),
            glm::vec4(m[3], 1.0f)};
}

/// Layers of strands, each a pixel wide, over the silhouette: fewer show through here and there,
/// more cost time and show nothing.
constexpr float kLayersOnScreen = 40.0f;

/// Share of the strands that a groom of this size on the screen calls for.
float share_on_screen(const LibraryGroom& groom, const glm::dmat4& world, const scene::Box& box,
                      const scene::ViewState& view) {
    if (box.empty() || groom.layers <= 0.0f) return 1.0f;
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(world))));
    const glm::dvec3 nearest = glm::clamp(view.pose.position, box.min, box.max);
    const double distance =
        std::max(glm::distance(nearest, view.pose.position), double{view.view.near_plane});
    const double layers = groom.layers / scale * view.view.pixel_angle * distance;
    return static_cast<float>(kLayersOnScreen / std::max(layers, 1e-6));
}

/// The coarsest level that keeps `share` of the strands.
StrandLevel level_for(const LibraryGroom& groom, float share) {
    StrandLevel chosen{groom.strands.strand_count, groom.strands.point_count,
                       groom.strands.segment_count};
    if (groom.cards) return chosen;
    for (const StrandLevel& level : groom.levels) {
        // Levels are random subsets: within a few percent of their share.
        if (static_cast<float>(level.strands) < 0.97f * share * groom.strands.strand_count) break;
        chosen = level;
    }
    return chosen;
}

HairDraw describe_draw(const LibraryGroom& groom, const StrandLevel& level, const glm::dmat4& world,
                       const HairMaterial& material, const HairWidth& width,
                       const HairTechniques& techniques) {
    const double volume = std::abs(glm::determinant(glm::dmat3(world)));
    const bool given = width.root > 0.0f;
    const bool from_column = !given && groom.has_width_column;
    return {.strands = &groom.strands,
            .cards = groom.cards ? &groom.cards : nullptr,
            .point_count = level.points,
            .positions = groom.strands.positions.address(),
            .world = world,
            .width = from_column ? 0.0f : (given ? width.root : groom.width),
            .tip_scale = width.tip_scale,
            // A width that is given is in metres of the world, however the node scales its groom.
            .scale = level.thicken * (given ? 1.0f : static_cast<float>(std::cbrt(volume))),
            .alpha = material.alpha,
            .opacity = techniques.opacity,
            .primitives = groom.cards ? groom.cards.triangle_count : level.segments,
            .shadow = techniques.shadow,
            .environment = techniques.environment,
            .scattering = techniques.scattering,
            .multiple = techniques.multiple,
            .optics = fibre_optics(material)};
}

/// Diameter of its strands in the world, halfway from root to tip.
float mean_width(const HairDraw& draw, const LibraryGroom& groom) {
    return (draw.width > 0.0f ? draw.width : groom.width) * draw.scale *
           (0.5f + 0.5f * draw.tip_scale);
}

float longest_side(const scene::Box& box) {
    if (box.empty()) return 0.0f;
    const glm::dvec3 size = box.max - box.min;
    return static_cast<float>(std::max({size.x, size.y, size.z}));
}

/// The groom's axes as its node turns them, the environment's light along each, and its thickness.
void describe_ambient(const LibraryGroom& groom, const glm::dmat4& world, const HairWidth& width,
                      float alpha, const light::LightBlock& lights, HairInstance& instance) {
    light::glsl::Sh9 sh;
    std::ranges::copy(lights.environment, sh.c);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 axis(world[i]);
        const double length = glm::length(axis);
        const glm::vec3 unit = length > 0.0 ? glm::vec3(axis / length) : glm::vec3(0.0f);
        const auto k = static_cast<size_t>(i);
        instance.ambient_axes[k] = unit;
        instance.ambient_light[k] = light::glsl::sh_irradiance_over_pi(sh, unit);
        instance.ambient_light[k + 3] = light::glsl::sh_irradiance_over_pi(sh, -unit);
    }
    instance.ambient = groom.strands.ambient.address();
    instance.ambient_scale = drawn_thickness(groom, width, alpha, world);
}

HairInstance describe_instance(const LibraryGroom& groom, const HairMaterial& material,
                               const HairShadow& shadow, const HairTechniques& techniques) {
    const StrandBuffers& strands = groom.strands;
    const bool has_colors = groom.has_colors && material.use_groom_colors;
    HairInstance instance{};
    instance.positions = instance.previous_positions = strands.positions.address();
    instance.parameters = strands.parameters.address();
    instance.colors = strands.colors.address();
    instance.segment_point = strands.segment_point.address();
    instance.segment_strand = strands.segment_strand.address();
    instance.strand_seed = strands.strand_seed.address();
    instance.cards = groom.cards ? groom.cards.set.address() : 0;
    instance.flags = has_colors ? kHasColors : 0u;
    const RootTipColors colors = root_tip_colors(groom, material);
    instance.base_color = colors.root;
    instance.color_variation = material.color_variation;
    instance.tip_color = colors.tip;
    instance.gradient_start = material.gradient_start;
    instance.specular = 0.5f * material.specular;  // the shading takes 0.5 for physical
    instance.roughness = material.roughness;
    instance.scatter = techniques.multiple == MultipleTechnique::kNone ? 0.0f : material.scatter;
    instance.shift = std::sin(material.shift);
    instance.shadow_falloff = shadow.falloff;
    instance.shadow_first = shadow.first;
    return instance;
}

/// Whether, and from where, points of this groom are its own this frame.
std::optional<HairDeform> describe_deform(const HairBinding* binding, const HairMoves* moves,
                                          const glm::dmat4& world, const glm::dmat4& previous_world,
                                          const HairPoses& poses) {
    HairDeform deform{.anchor = world[3]};
    if (binding != nullptr && binding->pose != kNoPose) {
        deform.pose = binding->pose;
        deform.anchor = poses.list[binding->pose].anchor;
        return deform;
    }
    if (moves == nullptr || !moves->now) return std::nullopt;
    deform.node = scene::relative_affine(world, deform.anchor);
    deform.previous_node = scene::relative_affine(previous_world, deform.anchor);
    return deform;
}

}  // namespace

float drawn_thickness(const LibraryGroom& groom, const HairWidth& width, float alpha,
                      const glm::dmat4& world) {
    // The atlas of cards has the strands as wide as they are drawn.
    if (groom.cards) return alpha;
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(world))));
    const float nominal = groom.width > 0.0f ? groom.width : kNominalWidth;
    const float drawn =
        width.root > 0.0f ? width.root / static_cast<float>(std::max(scale, 1e-12)) : nominal;
    return alpha * drawn / nominal;
}

bool in_view(const scene::Box& box, const scene::ViewState& view) {
    // Outside if all corners lie beyond one plane of the frustum; near is w > 0 with reversed
    // depth.
    std::array<int, 5> beyond{};
    for (const glm::dvec3& corner : box.corners()) {
        const glm::vec4 clip = view.view.view_projection * glm::vec4(view.relative(corner), 1.0f);
        beyond[0] += clip.x < -clip.w ? 1 : 0;
        beyond[1] += clip.x > clip.w ? 1 : 0;
        beyond[2] += clip.y < -clip.w ? 1 : 0;
        beyond[3] += clip.y > clip.w ? 1 : 0;
        beyond[4] += clip.w <= 0.0f ? 1 : 0;
    }
    return std::ranges::none_of(beyond, [](int corners) { return corners == 8; });
}

std::string_view text(EffectReason reason) {
    switch (reason) {
        case EffectReason::kChosen:
            return "chosen for this groom";
        case EffectReason::kOutOfView:
            return "off: out of view";
        case EffectReason::kNoShadowingLight:
            return "off: no light casts shadows";
        case EffectReason::kNoEnvironment:
            return "off: the environment is black";
        case EffectReason::kNoScatter:
            return "off: the material's scatter is 0";
        case EffectReason::kTransparent:
            return "off: the material's alpha is 0";
        case EffectReason::kNoStrands:
            return "off: the groom has no strands";
    }
    return "";
}

void update_hair_bounds(HairBoundsQuery hair, Res<const HairLibrary> library) {
    hair.each([&](const Hair& item, const scene::WorldTransform& world, scene::WorldBounds& out) {
        out.box = scene::transform(world.matrix, groom_box(library->grooms[item.groom]));
    });
}

void empty_clear_bounds(Query<const HairMaterial, scene::WorldBounds, With<Hair>> hair) {
    hair.each([](const HairMaterial& material, scene::WorldBounds& bounds) {
        if (material.alpha <= 0.0f) bounds.box = {};
    });
}

void gather_hair(HairQuery hair, Res<const HairLibrary> library, Res<const HairBindings> bindings,
                 Res<const HairPoses> poses, Res<const scene::ViewState> view,
                 Res<const light::LightSet> lights, Res<HairFrame> frame) {
    frame->instances.clear();
    frame->draws.clear();
    frame->casters.clear();
    frame->effects.clear();
    frame->deforms.clear();
    frame->projected = frame->card_vertices = frame->layers = frame->visibility = {};
    frame->largest_caster = 0.0f;
    frame->points = frame->card_points = frame->segments = 0;
    const scene::View& v = view->view;
    const glm::dvec3 camera = view->pose.position;
    hair.each([&](Entity entity, const Hair& item, const scene::WorldTransform& world,
                  const scene::PreviousWorldTransform& before, const scene::WorldBounds& bounds,
                  const HairMaterial& material, const HairWidth& width, const HairShadow& shadow,
                  const HairTechniques& chosen, const HairBinding* binding, const HairMoves* moves,
                  const HairDetail* detail, const HairMotion* motion) {
        const LibraryGroom& groom = library->grooms[item.groom];
        HairEffects effects =
            plan(item, groom, material, chosen, in_view(bounds.box, *view), lights->block);
        const float share = detail == nullptr ? 1.0f
                            : detail->share > 0.0f
                                ? detail->share
                                : share_on_screen(groom, world.matrix, bounds.box, *view);
        const StrandLevel level = level_for(groom, share);
        effects.strands = level.strands;
        if (motion != nullptr) {
            effects.motion = motion->reason;
            effects.solver = motion->solver;
        }
        frame->effects.push_back(effects);
        HairDraw draw =
            describe_draw(groom, level, world.matrix, material, width, effects.techniques);
        const bool casts = effects.techniques.shadow != ShadowTechnique::kNone;
        if (!effects.drawn && !casts) return;
        glm::dmat4 previous_world = before.known ? before.matrix : world.matrix;
        if (auto deform = describe_deform(binding, moves, world.matrix, previous_world, *poses)) {
            deform->entity = entity;
            deform->strands = &groom.strands;
            if (deform->pose != kNoPose) deform->bound = &bindings->list[binding->roots];
            draw.deform = static_cast<uint32_t>(frame->deforms.size());
            draw.world = previous_world = glm::translate(glm::dmat4(1.0), deform->anchor);
            frame->deforms.push_back(*deform);
        }
        if (casts) {
            frame->casters.push_back(draw);
            frame->largest_caster = std::max(frame->largest_caster, longest_side(bounds.box));
        }
        if (!effects.drawn) return;

        HairInstance instance = describe_instance(groom, material, shadow, effects.techniques);
        instance.width = mean_width(draw, groom);
        if (draw.environment == EnvironmentTechnique::kShDepth) {
            describe_ambient(groom, world.matrix, width, material.alpha, lights->block, instance);
        }
        instance.to_relative = affine(draw.world, camera);
        instance.to_clip = v.view_projection_unjittered * instance.to_relative;
        instance.previous_to_clip = v.previous_view_projection * affine(previous_world, camera);
        draw.to_clip = v.view_projection * instance.to_relative;
        draw.first_id = frame->segments;
        draw.rect = pixels_of(bounds.box, *view);
        instance.first_point = draw.first_point = frame->points;
        draw.first_card_point = frame->card_points;
        (draw.cards ? frame->card_points : frame->points) += draw.point_count;
        frame->segments += draw.primitives;
        frame->instances.push_back(instance);
        frame->draws.push_back(draw);
    });
}

}  // namespace vellus::hair
