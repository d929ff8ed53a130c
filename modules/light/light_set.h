#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/light/light_data.h"
#include "modules/scene/bounds.h"
#include "modules/scene/components.h"
#include "modules/scene/render_frame.h"
#include "modules/scene/view.h"

namespace vellus::light {

/// Marks what shadow maps should resolve finely: a sun's maps of opaque casters are fitted around
/// all that has it, its maps of hair around hair alone.
struct ShadowFocus {
    bool hair = false;
};

/// Sides of shadow maps in texels. Resource.
struct ShadowSettings {
    uint32_t size = 1024;  ///< at most; a power of two; 0 switches shadows off
    /// Maps get no finer than the picture: a texel is about a pixel where the focus is.
    bool fit_to_picture = true;
};

/// The lights of this frame, the strongest kMaxLights, and how their shadow maps see the world.
/// Resource, written by gather_lights; hair puts the addresses of its maps in.
struct LightSet {
    LightBlock block;
    /// World to clip space of each light's map of hair, and texels one metre covers at w = 1.
    std::array<glm::dmat4, kMaxLights> world_to_hair{};
    std::array<float, kMaxLights> hair_texels_per_metre{};
    uint32_t hair_size = 0;    ///< texels along a side of every map of hair
    uint32_t opaque_size = 0;  ///< and of every tile of opaque casters
    uint32_t left_out = 0;     ///< lights beyond kMaxLights
    /// Where texels of a sun's maps are counted from: the middle of the scene when it was first
    /// lit.
    std::optional<glm::dvec3> grid_origin;
};

/// How much a light counts beside others: its intensity in its strongest channel.
float strength(const scene::Light& light);

/// System: punctual lights to camera-relative LightSet with fitted shadow views.
void gather_lights(Query<const scene::MeshInstance> meshes,
                   Query<const scene::Light, const scene::WorldTransform> lights,
                   Query<const scene::WorldBounds, const ShadowFocus*> bounds,
                   Res<const scene::ViewState> view, Res<const scene::ViewSettings> picture,
                   Res<const ShadowSettings> settings, Res<LightSet> set);

/// System: pass "light/shadow_atlas", empty depth for the opaque casters of all lights; one texel
/// where nothing casts. Meshes are drawn into its tiles by whoever owns them.
void describe_shadow_atlas(Res<const LightSet> set, Res<scene::RenderFrame> frame);

/// System: the LightSet into this frame's uploads.
void upload_lights(Res<const LightSet> set, Res<scene::RenderFrame> frame);

}  // namespace vellus::light
