#pragma once

#include <optional>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/scene/camera.h"
#include "modules/scene/components.h"
#include "modules/scene/time.h"
#include "shaders/common/portable.h"

namespace vellus::scene {

namespace glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/view.glsl"
}  // namespace glsl

using glsl::View;
static_assert(sizeof(View) == 3 * 64 + 3 * 12 + 8 + 12 + 8 + 8 + 6 * 4, "scalar layout");

/// What the host and the temporal module decide about the next picture. Resource.
struct ViewSettings {
    glm::uvec2 size{1280, 720};
    glm::vec2 jitter{0.0f};  ///< pixels, right and down
    float exposure = 1.0f;
    bool cut = false;  ///< true in the frame after a camera cut or resize
};

/// The frame's view and what the next frame needs of it. Resource, written by update_view.
struct ViewState {
    View view{};
    CameraPose pose;
    std::optional<CameraPose> previous_pose;

    /// World position to what shaders see.
    [[nodiscard]] glm::vec3 relative(const glm::dvec3& position) const {
        return glm::vec3(position - pose.position);
    }
};

/// Reversed-Z projection with an infinite far plane; Vulkan clip space (Y down, z in 0..w).
glm::dmat4 projection(float vertical_fov, double aspect, double near_plane);

/// The view of one frame; `previous` is last frame's pose, empty on the first frame and on a cut.
View make_view(const CameraPose& pose, const std::optional<CameraPose>& previous,
               const ViewSettings& settings, const FixedStep& step);

/// World affine matrix to camera-relative float, the subtraction done in double.
glm::mat4x3 relative_affine(const glm::dmat4& world, const glm::dvec3& camera);

/// System: the active camera (the first by entity, if several) becomes the frame's view; without
/// one the last pose stays.
void update_view(Query<Entity, const Camera, const WorldTransform, With<ActiveCamera>> cameras,
                 Res<const ViewSettings> settings, Res<const FixedStep> step, Res<ViewState> state);

}  // namespace vellus::scene
