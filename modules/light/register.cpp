#include "modules/light/register.h"

#include "modules/light/environment.h"
#include "modules/scene/stages.h"

namespace vellus::light {

void register_light(World& world, Schedule& schedule) {
    world.insert_resource(LightSet{});
    world.insert_resource(ShadowSettings{});
    world.insert_resource(Environment{});
    world.insert_resource(SkyPipeline{});
    schedule.add(gather_lights).in(scene::kGather);
    schedule.add(gather_environment).in(scene::kGather).after(gather_lights);
    schedule.add(describe_shadow_atlas).in(scene::kLighting);
    schedule.add(upload_lights).in(scene::kLighting).after(describe_shadow_atlas);
    schedule.add(describe_sky).in(scene::kSky);
}

}  // namespace vellus::light
