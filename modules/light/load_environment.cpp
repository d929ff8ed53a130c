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

Result<EnvironmentImage> read_environment(const EnvironmentExtension& from,
                                          const std::filesystem::path& folder) {
    auto image = asset::load_image_f(folder / from.image);
    if (!image) return image.error();
    return EnvironmentImage{std::move(*image), from.intensity, from.rotation,
                            std::exp2(from.exposure)};
}

EnvironmentImage sky_environment(const Sky& sky) {
    return {.pixels = render_sky(sky, kSkyWidth, kSkyHeight)};
}

Result<void> use_environment(World& world, gpu::Device& device, const EnvironmentImage& image) {
    auto environment = make_environment(device, image.pixels, image.intensity, image.rotation);
    if (!environment) return environment.error();
    world.resource<Environment>() = std::move(*environment);
    if (image.exposure) world.resource<scene::ViewSettings>().exposure = *image.exposure;
    return {};
}

Result<void> load_environment(World& world, gpu::Device& device, const EnvironmentExtension& from,
                              const std::filesystem::path& folder) {
    auto image = read_environment(from, folder);
    if (!image) return image.error();
    return use_environment(world, device, *image);
}

Result<void> use_sky(World& world, gpu::Device& device, const Sky& sky) {
    return use_environment(world, device, sky_environment(sky));
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
