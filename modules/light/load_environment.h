#pragma once

#include <filesystem>

#include "engine/ecs/ecs.h"
#include "engine/gpu/device.h"
#include "modules/light/environment_extension.h"
#include "modules/light/sky.h"
#include "modules/scene/components.h"

namespace vellus::light {

/// The image of a VELLUS_environment extension becomes the world's Environment; its exposure goes
/// into ViewSettings. `folder` holds the glTF file.
Result<void> load_environment(World& world, gpu::Device& device, const EnvironmentExtension& from,
                              const std::filesystem::path& folder);

/// The default sky becomes the Environment.
Result<void> use_sky(World& world, gpu::Device& device, const Sky& sky);

/// The sun that belongs to the sky: how it stands, how it shines, and both as a light entity.
scene::LocalTransform sun_transform(const Sky& sky);
scene::Light sun_light(const Sky& sky);
Entity spawn_sun(World& world, const Sky& sky);

}  // namespace vellus::light
