#include "game_demo/src/viewer.h"

#include <algorithm>
#include <cmath>

#include "modules/scene/instantiate.h"
#include "modules/scene/view.h"

namespace vellus::demo {

namespace {

constexpr double kEyeHeight = 1.0;  ///< metres above the player's feet that the camera looks at
constexpr double kFollowDistance = 3.8;  ///< metres at least, to see feet and head
constexpr double kFollowTime = 0.12;     ///< seconds the camera lags behind the player

}  // namespace

const char* text(CameraMode mode) {
    constexpr const char* kTexts[] = {"scene", "orbit", "free", "follow"};
    return kTexts[static_cast<size_t>(mode)];
}

Viewer::Viewer(World& world) : world_(world) {
    world.query<Entity, const scene::ActiveCamera>().each(
        [&](Entity entity, const scene::ActiveCamera&) { scene_camera_ = entity; });
}

void Viewer::update(const Input* input, double height, double seconds,
                    const std::optional<glm::dvec3>& player) {
    if (mode_ == CameraMode::kScene) {
        Orbit probe = orbit_;
        if (input == nullptr || !steer(probe, *input, height)) return;
        set_mode(CameraMode::kOrbit);
    }
    if (mode_ == CameraMode::kFree) {
        if (input != nullptr) fly(*input, height, seconds);
    } else if (input != nullptr) {
        steer(orbit_, *input, height);
    }
    if (mode_ == CameraMode::kFollow && player) {
        const glm::dvec3 target = *player + glm::dvec3(0.0, kEyeHeight, 0.0);
        orbit_.target += (target - orbit_.target) * (1.0 - std::exp(-seconds / kFollowTime));
    }
    place();
}

void Viewer::fly(const Input& input, double height, double seconds) {
    look_around(orbit_, input, height);
    if (input.scroll_y != 0.0) {
        fly_speed_ = std::clamp(fly_speed_ * std::pow(1.2, input.scroll_y), 1e-3, 1e5);
    }
    const glm::dvec3 wish = movement(input);
    const double speed = fly_speed_ * (input.key(Key::kShift).held ? 4.0 : 1.0);
    orbit_.target += scene::orbit_axes(orbit_.yaw, orbit_.pitch) * wish * (speed * seconds);
}

void Viewer::turn(double radians) {
    if (mode_ == CameraMode::kScene) set_mode(CameraMode::kOrbit);
    orbit_.yaw = std::remainder(orbit_.yaw + radians, 2.0 * std::acos(-1.0));
    place();
}

double Viewer::yaw() const {
    const glm::dvec3 back = world_.resource<scene::ViewState>().pose.axes[2];
    return std::atan2(back.x, back.z);
}

void Viewer::place() {
    const scene::CameraPose pose = pose_of(orbit_);
    *world_.get<scene::LocalTransform>(own_camera_) = scene::local_transform(pose);
    world_.get<scene::Camera>(own_camera_)->near_plane = pose.near_plane;
}

void Viewer::set_mode(CameraMode mode) {
    if (mode == mode_) return;
    mode_ = mode;
    if (mode == CameraMode::kScene) {
        world_.destroy(own_camera_);
        own_camera_ = kNoEntity;
        world_.add(scene_camera_, scene::ActiveCamera{});
        world_.resource<scene::ViewSettings>().cut = true;
        return;
    }
    if (own_camera_ == kNoEntity) take_over();
    if (mode == CameraMode::kFollow) orbit_.distance = std::max(orbit_.distance, kFollowDistance);
    place();
}

void Viewer::take_over() {
    scene::Box box;
    world_.query<const scene::WorldBounds>().each([&](const scene::WorldBounds& bounds) {
        if (!bounds.box.empty()) box.include(bounds.box);
    });
    const glm::dvec3 center = box.empty() ? glm::dvec3(0.0) : box.center();
    orbit_ = orbit_from(world_.resource<scene::ViewState>().pose, center);
    own_camera_ = scene::spawn_camera(world_, pose_of(orbit_));
    world_.remove<scene::ActiveCamera>(scene_camera_);
}

}  // namespace vellus::demo
