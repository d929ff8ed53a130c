#include "modules/character/register.h"

#include "modules/character/animation.h"
#include "modules/character/deform.h"
#include "modules/scene/stages.h"
#include "modules/scene/transform.h"

namespace vellus::character {

void register_character(World& world, Schedule& schedule) {
    if (world.find_resource<DeformColumns>() == nullptr) world.emplace_resource<DeformColumns>();
    schedule.add(bind_meshes).in(scene::kSimulate);
    schedule.add(animate).in(scene::kSimulate).after(bind_meshes);
    schedule.add(update_palettes).in(scene::kTransforms).after(scene::propagate_transforms);
    schedule.add(update_bounds).in(scene::kTransforms).after(update_palettes);
}

}  // namespace vellus::character
