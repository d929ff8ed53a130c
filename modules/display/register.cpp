#include "modules/display/register.h"

#include "modules/display/display.h"
#include "modules/scene/stages.h"

namespace vellus::display {

void register_display(World& world, Schedule& schedule) {
    world.insert_resource(DisplayPipelines{});
    schedule.add(describe_tonemap).in(scene::kDisplay);
}

}  // namespace vellus::display
