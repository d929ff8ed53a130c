#include "modules/temporal/register.h"

#include "modules/scene/stages.h"
#include "modules/temporal/temporal.h"

namespace vellus::temporal {

void register_temporal(World& world, Schedule& schedule) {
    world.insert_resource(TemporalSettings{});
    world.insert_resource(TemporalPipelines{});
    schedule.add(jitter_view).in(scene::kView).before(scene::update_view);
    schedule.add(describe_taa).in(scene::kTemporal);
}

}  // namespace vellus::temporal
