#pragma once

#include <array>
#include <map>

#include "modules/hair/cards/card_passes.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/hair/geometry/strand_raster.h"
#include "modules/hair/shadow/deep_opacity.h"
#include "modules/scene/render_frame.h"

namespace vellus::hair {

/// Specialization constants 0, 1, ... of shade.comp.glsl; see there.
using ShadeConstants = std::array<uint32_t, 8>;

/// Pipelines of the hair passes, made when first needed. Resource.
struct HairPipelines {
    const gpu::Pipeline* project = nullptr;
    const gpu::Pipeline* visibility = nullptr;
    const gpu::Pipeline* visibility_still = nullptr;
    const gpu::Pipeline* shadow_depth = nullptr;
    CardPipelines cards;
    DeepPipelines deep;
    std::map<ShadeConstants, const gpu::Pipeline*> shade;
};

/// Hair depth of all lights, float bits of reversed depth; made when a light first shadows hair.
/// Resource.
struct HairShadowMaps {
    gpu::Buffer depth;
    gpu::Buffer layers;  ///< of deep_opacity (shaders/hair/shadow/deep_opacity.glsl)
};

/// System: memory for the maps of lights that shadow hair, and their addresses into the LightSet.
void assign_hair_shadows(Res<const HairFrame> hair, Res<light::LightSet> lights,
                         Res<HairShadowMaps> maps, Res<scene::RenderFrame> frame);

/// System: pass "hair/project", all points to pixels.
void describe_hair_projection(Res<HairFrame> hair, Res<HairPipelines> pipelines,
                              Res<FibreLibrary> fibres, Res<scene::RenderFrame> frame);

/// System: passes "hair/shadow_*" and "hair/deep_*", the hair seen from each light.
void describe_hair_shadows(Res<HairFrame> hair, Res<const light::LightSet> lights,
                           Res<HairShadowMaps> maps, Res<HairPipelines> pipelines,
                           Res<scene::RenderFrame> frame);

/// System: passes "hair/visibility" and "hair/shade", hair over the picture.
void describe_hair(Res<HairFrame> hair, Res<const light::LightSet> lights,
                   Res<HairPipelines> pipelines, Res<scene::RenderFrame> frame);

}  // namespace vellus::hair
