#define GLM_ENABLE_EXPERIMENTAL
#include "modules/light/load_environment.h"

#include <cmath>
#include <glm/gtx/quaternion.hpp>

#include "engine/asset/image_io.h"
#include "modules/light/environment.h"
#include "modules/scene/components.h"
#include "modules/scene/view.h"

namespace vellus::light {

namespace {

constexpr uint32_t kSkyWidth = 1024;
constexpr uint32_t kSkyHeight = 512;

}  // namespace

Result<void> load_environment(World& world, gpu::Device& device, const EnvironmentExtension& from,
                              const std::filesystem::path& folder) {
    auto image = asset::load_image_f(folder / from.image);
    if (!image) return image.error();
    auto environment = make_environment(device, *image, from.intensity, from.rotation);
    if (!environment) return environment.error();
    world.resource<Environment>() = std::move(*environment);
    world.resource<scene::ViewSettings>().exposure = std::exp2(from.exposure);
    return {};
}

Result<void> use_sky(World& world, gpu::Device& device, const Sky& sky) {
    auto environment = make_environment(device, render_sky(sky, kSkyWidth, kSkyHeight), 1.0f, 0.0f);
    if (!environment) return environment.error();
    world.resource<Environment>() = std::move(*environment);
    return {};
}

scene::LocalTransform sun_transform(const Sky& sky) {
    // A light shines along -Z: turn +Z towards the sun.
    return {.rotation = glm::rotation(glm::vec3(0.0f, 0.0f, 1.0f), sky_sun(sky).to_sun)};
}

scene::Light sun_light(const Sky& sky) {
    return {.kind = asset::LightKind::kDirectional,
            .color = sky_sun(sky).irradiance,
            .intensity = 1.0f};
}

Entity spawn_sun(World& world, const Sky& sky) {
    return world.spawn(sun_transform(sky), scene::WorldTransform{}, scene::PreviousWorldTransform{},
                       sun_light(sky));
}

}  // namespace vellus::light
