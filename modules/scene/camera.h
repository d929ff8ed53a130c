#pragma once

#include <glm/glm.hpp>
#include <span>

#include "modules/scene/bounds.h"
#include "modules/scene/components.h"

namespace vellus::scene {

/// A camera in the world: columns of `axes` are right, up and back (it looks along -Z).
struct CameraPose {
    glm::dvec3 position{0.0};
    glm::dmat3 axes{1.0};
    float vertical_fov = 0.8f;
    float near_plane = 0.1f;
};

/// The pose of a camera node; scale and shear of `world` are removed, the field of view kept within
/// [1e-3, 3.14] radians and the near plane within [1e-6, 1e6] metres (not a number: the default).
CameraPose camera_pose(const Camera& camera, const glm::dmat4& world);

/// LocalTransform of a root entity with this pose.
LocalTransform local_transform(const CameraPose& pose);

/// Yaw turns about Y (0 looks along -Z), positive pitch looks down from above.
glm::dmat3 orbit_axes(double yaw, double pitch);

/// A camera `distance` metres from `target`, looking at it.
CameraPose orbit_pose(const glm::dvec3& target, double distance, double yaw, double pitch,
                      float vertical_fov = 0.6f);

/// The nearest camera of this direction that sees all points inside the middle `fill` (0..1] of a
/// picture of `aspect` = width / height; the picture's tighter axis is filled exactly. No points:
/// looks at the origin from 1 m.
CameraPose frame_points(std::span<const glm::dvec3> points, double yaw, double pitch, double aspect,
                        double fill = 0.9, float vertical_fov = 0.6f);
/// The same for the corners of a box.
CameraPose frame_box(const Box& box, double yaw, double pitch, double aspect, double fill = 0.9,
                     float vertical_fov = 0.6f);

}  // namespace vellus::scene
