#include "modules/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vellus::scene {
namespace {

/// One axis of the fit: the least distance and the lateral shift at which every point's offset
/// stays within `slope` x its depth from the camera.
struct AxisFit {
    explicit AxisFit(double slope_in) : slope(slope_in) {}
    void include(double offset, double depth) {
        high = std::max(high, offset - slope * depth);
        low = std::min(low, offset + slope * depth);
    }
    [[nodiscard]] double shift() const { return 0.5 * (high + low); }
    [[nodiscard]] double distance() const { return 0.5 * (high - low) / slope; }

    double slope;
    double high = -std::numeric_limits<double>::infinity();
    double low = std::numeric_limits<double>::infinity();
};

/// `value` within [low, high]; `fallback` where it is not a number.
float clamped(float value, float low, float high, float fallback) {
    return std::isnan(value) ? fallback : std::clamp(value, low, high);
}

}  // namespace

CameraPose camera_pose(const Camera& camera, const glm::dmat4& world) {
    CameraPose pose;
    pose.position = glm::dvec3(world[3]);
    pose.vertical_fov = clamped(camera.vertical_fov, 1e-3f, 3.14f, pose.vertical_fov);
    pose.near_plane = clamped(camera.near_plane, 1e-6f, 1e6f, pose.near_plane);
    const glm::dvec3 back(world[2]);
    const glm::dvec3 right = glm::cross(glm::dvec3(world[1]), back);
    if (glm::dot(back, back) > 0.0 && glm::dot(right, right) > 0.0) {
        pose.axes[2] = glm::normalize(back);
        pose.axes[0] = glm::normalize(right);
        pose.axes[1] = glm::cross(pose.axes[2], pose.axes[0]);
    }
    return pose;
}

LocalTransform local_transform(const CameraPose& pose) {
    return {pose.position, glm::quat(glm::normalize(glm::quat_cast(pose.axes))), glm::vec3(1.0f)};
}

glm::dmat3 orbit_axes(double yaw, double pitch) {
    const glm::dvec3 back(std::cos(pitch) * std::sin(yaw), std::sin(pitch),
                          std::cos(pitch) * std::cos(yaw));
    const glm::dvec3 right(std::cos(yaw), 0.0, -std::sin(yaw));
    return {right, glm::cross(back, right), back};
}

CameraPose orbit_pose(const glm::dvec3& target, double distance, double yaw, double pitch,
                      float vertical_fov) {
    CameraPose pose;
    pose.axes = orbit_axes(yaw, pitch);
    pose.position = target + pose.axes[2] * distance;
    pose.vertical_fov = vertical_fov;
    pose.near_plane = static_cast<float>(std::max(1e-4, 0.02 * distance));
    return pose;
}

CameraPose frame_points(std::span<const glm::dvec3> points, double yaw, double pitch, double aspect,
                        double fill, float vertical_fov) {
    if (points.empty()) return orbit_pose(glm::dvec3(0.0), 1.0, yaw, pitch, vertical_fov);
    const glm::dmat3 axes = orbit_axes(yaw, pitch);
    const double slope = std::tan(0.5 * vertical_fov) * fill;
    AxisFit horizontal(slope * aspect);
    AxisFit vertical(slope);
    // Offsets are taken from one of the points: far from the origin they would lose their digits.
    const glm::dvec3 origin = points[0];
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 offset = (point - origin) * axes;
        horizontal.include(offset.x, -offset.z);
        vertical.include(offset.y, -offset.z);
        nearest = std::min(nearest, -offset.z);
        farthest = std::max(farthest, -offset.z);
    }
    double distance = std::max(horizontal.distance(), vertical.distance());
    // A single point or a line towards the camera needs no distance; keep some anyway.
    const double least = farthest > nearest ? 0.05 * (farthest - nearest) : 1e-3;
    distance = std::max(distance, least - nearest);
    CameraPose pose;
    pose.axes = axes;
    pose.position = origin + axes * glm::dvec3(horizontal.shift(), vertical.shift(), distance);
    pose.vertical_fov = vertical_fov;
    pose.near_plane = static_cast<float>(0.1 * (distance + nearest));
    return pose;
}

CameraPose frame_box(const Box& box, double yaw, double pitch, double aspect, double fill,
                     float vertical_fov) {
    if (box.empty()) return frame_points({}, yaw, pitch, aspect, fill, vertical_fov);
    const auto corners = box.corners();
    return frame_points(corners, yaw, pitch, aspect, fill, vertical_fov);
}

}  // namespace vellus::scene
