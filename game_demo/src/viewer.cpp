#include "game_demo/src/viewer.h"

#include "modules/scene/view.h"

namespace vellus::demo {

Viewer::Viewer(World& world) : world_(world) {
    world.query<Entity, const scene::ActiveCamera>().each(
        [&](Entity entity, const scene::ActiveCamera&) { scene_camera_ = entity; });
}

void Viewer::update(const Input& input, double height) {
    Orbit steered = orbit_;
    if (own_camera_ == kNoEntity) {
        if (!steer(steered, input, height)) return;
        take_over();
    }
    if (steer(orbit_, input, height)) {
        *world_.get<scene::LocalTransform>(own_camera_) = scene::local_transform(pose_of(orbit_));
        world_.get<scene::Camera>(own_camera_)->near_plane = pose_of(orbit_).near_plane;
    }
}

void Viewer::take_over() {
    scene::Box box;
    world_.query<const scene::WorldBounds>().each([&](const scene::WorldBounds& bounds) {
        if (!bounds.box.empty()) box.include(bounds.box);
    });
    const glm::dvec3 center = box.empty() ? glm::dvec3(0.0) : box.center();
    orbit_ = orbit_from(world_.resource<scene::ViewState>().pose, center);
    const scene::CameraPose pose = pose_of(orbit_);
    own_camera_ = world_.spawn(scene::Camera{pose.vertical_fov, pose.near_plane},
                               scene::local_transform(pose), scene::WorldTransform{},
                               scene::PreviousWorldTransform{}, scene::ActiveCamera{});
    world_.remove<scene::ActiveCamera>(scene_camera_);
}

void Viewer::go_home() {
    if (own_camera_ == kNoEntity) return;
    world_.destroy(own_camera_);
    own_camera_ = kNoEntity;
    world_.add(scene_camera_, scene::ActiveCamera{});
    world_.resource<scene::ViewSettings>().cut = true;
}

}  // namespace vellus::demo
