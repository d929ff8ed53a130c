#include "game_demo/src/daylight.h"

#include <algorithm>

#include "modules/light/daylight.h"
#include "modules/light/light_set.h"
#include "modules/light/load_environment.h"
#include "modules/scene/components.h"

namespace vellus::demo {

Daylight::Daylight(World& world) {
    float strongest = 0.0f;
    world.query<Entity, const scene::Light>().each([&](Entity entity, const scene::Light& source) {
        const float power = light::strength(source);
        if (source.kind == asset::LightKind::kDirectional && power > strongest) {
            strongest = power;
            sun_ = entity;
        }
    });
}

Result<void> Daylight::set_hour(double hour, Renderer& renderer, gpu::Device& device) {
    hour_ = std::clamp(hour, 0.0, 24.0);
    World& world = renderer.world();
    const light::Sky sky = light::sky_at(hour_);
    if (auto idle = renderer.wait(); !idle) return idle;
    if (auto made = light::use_sky(world, device, sky); !made) return made;
    if (sun_ == kNoEntity) return {};
    *world.get<scene::LocalTransform>(sun_) = light::sun_transform(sky);
    *world.get<scene::Light>(sun_) = light::sun_light(sky);
    return {};
}

}  // namespace vellus::demo
