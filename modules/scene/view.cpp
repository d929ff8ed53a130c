#include "modules/scene/view.h"

#include <cmath>

namespace vellus::scene {
namespace {

/// World axes to camera axes.
glm::dmat4 view_rotation(const CameraPose& pose) {
    return {glm::transpose(pose.axes)};
}

double aspect_of(glm::uvec2 size) {
    return size.y == 0 ? 1.0 : static_cast<double>(size.x) / size.y;
}

}  // namespace

glm::dmat4 projection(float vertical_fov, double aspect, double near_plane) {
    const double focal = 1.0 / std::tan(0.5 * vertical_fov);
    glm::dmat4 matrix(0.0);
    matrix[0][0] = focal / aspect;
    matrix[1][1] = -focal;
    matrix[2][3] = -1.0;
    matrix[3][2] = near_plane;
    return matrix;
}

View make_view(const CameraPose& pose, const std::optional<CameraPose>& previous,
               const ViewSettings& settings, const FixedStep& step) {
    const CameraPose& before = previous ? *previous : pose;
    const double aspect = aspect_of(settings.size);
    const glm::dvec2 size = glm::max(glm::dvec2(settings.size), 1.0);
    const glm::dmat4 unjittered =
        projection(pose.vertical_fov, aspect, pose.near_plane) * view_rotation(pose);
    glm::dmat4 jitter(1.0);
    jitter[3] = glm::dvec4(2.0 * glm::dvec2(settings.jitter) / size, 0.0, 1.0);
    glm::dmat4 move(1.0);
    move[3] = glm::dvec4(pose.position - before.position, 1.0);

    View view{};
    view.view_projection = glm::mat4(jitter * unjittered);
    view.view_projection_unjittered = glm::mat4(unjittered);
    view.previous_view_projection = glm::mat4(
        projection(before.vertical_fov, aspect, before.near_plane) * view_rotation(before) * move);
    view.right = glm::vec3(pose.axes[0]);
    view.up = glm::vec3(pose.axes[1]);
    view.forward = glm::vec3(-pose.axes[2]);
    const double tan_half = std::tan(0.5 * pose.vertical_fov);
    view.tan_half_fov = glm::vec2(tan_half * aspect, tan_half);
    view.camera_delta = glm::vec3(pose.position - before.position);
    view.jitter = settings.jitter;
    view.size = settings.size;
    view.near_plane = pose.near_plane;
    view.pixel_angle = static_cast<float>(2.0 * tan_half / size.y);
    view.exposure = settings.exposure;
    view.frame_index = static_cast<uint32_t>(step.frame);
    view.seed = static_cast<uint32_t>(step.seed);
    view.cut = previous && !settings.cut ? 0 : 1;
    return view;
}

glm::mat4x3 relative_affine(const glm::dmat4& world, const glm::dvec3& camera) {
    return {glm::vec3(world[0]), glm::vec3(world[1]), glm::vec3(world[2]),
            glm::vec3(glm::dvec3(world[3]) - camera)};
}

void update_view(Query<Entity, const Camera, const WorldTransform, With<ActiveCamera>> cameras,
                 Res<const ViewSettings> settings, Res<const FixedStep> step,
                 Res<ViewState> state) {
    if (step->frame == 0) state->previous_pose.reset();
    Entity first = kNoEntity;
    CameraPose pose = state->pose;
    cameras.each([&](Entity entity, const Camera& camera, const WorldTransform& world) {
        if (first != kNoEntity && first < entity) return;
        first = entity;
        pose = camera_pose(camera, world.matrix);
    });
    if (settings->cut) state->previous_pose.reset();
    state->view = make_view(pose, state->previous_pose, *settings, *step);
    state->pose = pose;
    state->previous_pose = pose;
}

}  // namespace vellus::scene
