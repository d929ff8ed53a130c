#include "modules/hair/register.h"

#include "modules/character/deform.h"
#include "modules/hair/binding/deform_passes.h"
#include "modules/hair/dynamics/move_hair.h"
#include "modules/hair/dynamics/move_passes.h"
#include "modules/hair/environment/ambient_upload.h"
#include "modules/hair/environment/cover_meshes.h"
#include "modules/hair/geometry/hair_passes.h"
#include "modules/light/environment.h"
#include "modules/scene/stages.h"
#include "modules/scene/transform.h"

namespace vellus::hair {

void register_hair_columns(World& world, Schedule& schedule) {
    world.insert_resource(HairLibrary{});
    world.insert_resource(HairBindings{});
    world.insert_resource(HairPoses{});
    world.insert_resource(HairMotions{});
    world.insert_resource(Wind{});
    if (world.find_resource<character::DeformColumns>() == nullptr) {
        world.emplace_resource<character::DeformColumns>();
    }
    schedule.add(update_hair_bounds).in(scene::kTransforms).after(scene::propagate_transforms);
    schedule.add(pose_hair).in(scene::kView);
    schedule.add(move_hair).in(scene::kView).after(pose_hair).after(scene::update_view);
}

void register_hair(World& world, Schedule& schedule) {
    register_hair_columns(world, schedule);
    world.insert_resource(HairFrame{});
    world.insert_resource(HairPipelines{});
    world.insert_resource(FibreLibrary{});
    world.insert_resource(HairShadowMaps{});
    world.insert_resource(HairDeformation{});
    world.insert_resource(HairMotionPasses{});
    world.insert_resource(HairCovers{});
    schedule.add(empty_clear_bounds).in(scene::kView).after(move_hair);
    schedule.add(gather_hair)
        .in(scene::kGather)
        .after(light::gather_lights)
        .after(light::gather_environment);
    schedule.add(upload_ambient_depths).in(scene::kGather).after(gather_hair);
    schedule.add(cover_meshes).in(scene::kGather).after(upload_ambient_depths);
    schedule.add(update_sky_covers).in(scene::kGather).after(cover_meshes);
    schedule.add(assign_hair_points).in(scene::kGather).after(upload_ambient_depths);
    schedule.add(assign_hair_shadows).in(scene::kGather).after(assign_hair_points);
    schedule.add(describe_hair_deformation).in(scene::kStrands);
    schedule.add(describe_hair_motion).in(scene::kStrands).after(describe_hair_deformation);
    schedule.add(describe_hair_projection).in(scene::kStrands).after(describe_hair_motion);
    schedule.add(describe_hair_shadows).in(scene::kShadows);
    schedule.add(describe_hair).in(scene::kHair);
}

}  // namespace vellus::hair
