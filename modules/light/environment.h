#pragma once

#include "engine/gpu/image.h"
#include "modules/light/light_set.h"
#include "modules/light/sh.h"

namespace vellus::light {

/// What surrounds the scene: the image behind it and its spherical harmonics. Resource.
struct Environment {
    gpu::Image image;  ///< equirectangular, RGBA32F; empty: black
    ShRadiance radiance{};
    float intensity = 1.0f;
    float rotation = 0.0f;  ///< radians about +Y, counter-clockwise from above
    bool drawn = true;      ///< false: black behind the scene, though it still lights it
};

/// Made when the sky is first drawn. Resource.
struct SkyPipeline {
    const gpu::Pipeline* pipeline = nullptr;
};

/// Uploads an equirectangular image and projects it to SH.
Result<Environment> make_environment(gpu::Device& device, const asset::ImageF& equirect,
                                     float intensity, float rotation);

/// System: the environment's SH, turned and scaled, into the LightSet.
void gather_environment(Res<const Environment> environment, Res<LightSet> set);

/// System: the pass that draws the environment behind everything opaque.
void describe_sky(Res<const Environment> environment, Res<SkyPipeline> sky,
                  Res<scene::RenderFrame> frame);

}  // namespace vellus::light
