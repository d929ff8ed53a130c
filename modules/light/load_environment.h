#pragma once

#include <filesystem>
#include <optional>

#include "engine/asset/image.h"
#include "engine/ecs/ecs.h"
#include "engine/gpu/device.h"
#include "modules/light/environment_extension.h"
#include "modules/light/sky.h"
#include "modules/scene/components.h"

namespace vellus::light {

/// What surrounds a scene, not yet on any device.
struct EnvironmentImage {
    asset::ImageF pixels;  ///< equirectangular
    float intensity = 1.0f;
    float rotation = 0.0f;          ///< radians about +Y, counter-clockwise from above
    std::optional<float> exposure;  ///< factor on the picture, where the scene gives one
};

/// The image of a VELLUS_environment extension; `folder` holds the glTF file.
Result<EnvironmentImage> read_environment(const EnvironmentExtension& from,
                                          const std::filesystem::path& folder);

/// The default sky as an image.
EnvironmentImage sky_environment(const Sky& sky);

/// Becomes the world's Environment; its exposure goes into ViewSettings.
Result<void> use_environment(World& world, gpu::Device& device, const EnvironmentImage& image);

/// read_environment, then use_environment.
Result<void> load_environment(World& world, gpu::Device& device, const EnvironmentExtension& from,
                              const std::filesystem::path& folder);

/// The default sky becomes the Environment.
Result<void> use_sky(World& world, gpu::Device& device, const Sky& sky);

/// The sun that belongs to the sky: how it stands, how it shines, and both as a light entity.
scene::LocalTransform sun_transform(const Sky& sky);
scene::Light sun_light(const Sky& sky);
Entity spawn_sun(World& world, const Sky& sky);

}  // namespace vellus::light
