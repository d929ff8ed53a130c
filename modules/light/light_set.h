#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/light/light_data.h"
#include "modules/scene/bounds.h"
#include "modules/scene/components.h"
#include "modules/scene/render_frame.h"
#include "modules/scene/view.h"

namespace vellus::light {

/// Marks what shadow maps should resolve finely (hair); the sun's map is fitted around it.
struct ShadowFocus {};

/// Side of a shadow map in texels; 0 switches shadows off. Resource.
struct ShadowSettings {
    uint32_t size = 1024;
};

/// The lights of this frame, the strongest kMaxLights, and how their shadow maps see the world.
/// Resource, written by gather_lights; hair puts the addresses of its maps in.
struct LightSet {
    LightBlock block;
    /// World to clip space of each light's map, and pixels one metre covers at w = 1.
    std::array<glm::dmat4, kMaxLights> world_to_shadow{};
    std::array<float, kMaxLights> shadow_pixels_per_metre{};
    uint32_t left_out = 0;  ///< lights beyond kMaxLights
};

/// System: punctual lights to camera-relative LightSet with fitted shadow views.
void gather_lights(Query<const scene::MeshInstance> meshes,
                   Query<const scene::Light, const scene::WorldTransform> lights,
                   Query<const scene::WorldBounds, const ShadowFocus*> bounds,
                   Res<const scene::ViewState> view, Res<const ShadowSettings> settings,
                   Res<LightSet> set);

/// System: pass "light/shadow_atlas", empty depth for the opaque casters of all lights; one texel
/// where nothing casts. Meshes are drawn into its tiles by whoever owns them.
void describe_shadow_atlas(Res<const LightSet> set, Res<const ShadowSettings> settings,
                           Res<scene::RenderFrame> frame);

/// System: the LightSet into this frame's uploads.
void upload_lights(Res<const LightSet> set, Res<scene::RenderFrame> frame);

}  // namespace vellus::light
