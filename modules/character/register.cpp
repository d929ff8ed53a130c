#include "modules/character/register.h"

#include "modules/character/animation.h"
#include "modules/character/deform.h"
#include "modules/character/passes.h"
#include "modules/scene/stages.h"
#include "modules/scene/transform.h"

namespace vellus::character {
namespace {

template <class T>
void ensure_resource(World& world) {
    if (world.find_resource<T>() == nullptr) world.emplace_resource<T>();
}

}  // namespace

void register_character(World& world, Schedule& schedule) {
    ensure_resource<DeformColumns>(world);
    schedule.add(bind_meshes).in(scene::kSimulate);
    schedule.add(animate).in(scene::kSimulate).after(bind_meshes);
    schedule.add(update_palettes).in(scene::kTransforms).after(scene::propagate_transforms);
    schedule.add(update_bounds).in(scene::kTransforms).after(update_palettes);
}

void register_character_passes(World& world, Schedule& schedule) {
    ensure_resource<MeshLibrary>(world);
    ensure_resource<MeshDraws>(world);
    ensure_resource<MeshPasses>(world);
    schedule.add(gather_meshes).in(scene::kSkinning);
    schedule.add(describe_skinning).in(scene::kSkinning).after(gather_meshes);
    schedule.add(describe_mesh_shadows).in(scene::kCasters);
    schedule.add(describe_meshes).in(scene::kOpaque);
}

}  // namespace vellus::character
