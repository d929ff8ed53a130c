#include "modules/hair/reference/tracer/fibre_frame.h"

#include <algorithm>
#include <cmath>

namespace vellus::hair::tracer {

namespace {

constexpr double kDegenerate = 1e-12;

/// Any unit vector across `axis`.
glm::dvec3 across(const glm::dvec3& axis) {
    const glm::dvec3 helper = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(axis, helper));
}

}  // namespace

reference::Inclination FibreFrame::inclination(const glm::dvec3& direction) const {
    const double sin = std::clamp(glm::dot(tangent, direction), -1.0, 1.0);
    return {sin, std::sqrt(1.0 - sin * sin)};
}

double FibreFrame::azimuth(const glm::dvec3& direction) const {
    return std::atan2(glm::dot(direction, aside), glm::dot(direction, towards));
}

glm::dvec3 FibreFrame::direction(reference::Inclination i, double azimuth) const {
    return i.sin * tangent + i.cos * (std::cos(azimuth) * towards + std::sin(azimuth) * aside);
}

FibreFrame fibre_frame(const glm::dvec3& tangent, const glm::dvec3& normal,
                       const glm::dvec3& to_eye) {
    FibreFrame frame;
    frame.tangent = tangent;
    frame.eye = frame.inclination(to_eye);
    const glm::dvec3 eye_across = to_eye - frame.eye.sin * tangent;
    const double length = glm::length(eye_across);
    frame.towards = length > kDegenerate ? eye_across / length : across(tangent);
    frame.aside = glm::cross(tangent, frame.towards);
    // γo runs from the normal to the eye; on a ball at a strand's end the normal may lie along it.
    const glm::dvec3 normal_across = normal - glm::dot(normal, tangent) * tangent;
    const double normal_length = glm::length(normal_across);
    if (normal_length > kDegenerate) {
        frame.h = std::clamp(-glm::dot(normal_across, frame.aside) / normal_length, -1.0, 1.0);
    }
    return frame;
}

StrandPoint strand_point(const Groom& groom, uint32_t segment, double at) {
    const uint32_t i = groom.segment_point[segment];
    StrandPoint point;
    const glm::dvec3 tangent =
        glm::mix(glm::dvec3(groom.tangents[i]), glm::dvec3(groom.tangents[i + 1]), at);
    const glm::dvec3 chord = glm::dvec3(groom.points[i + 1]) - glm::dvec3(groom.points[i]);
    // Tangents that oppose each other leave no direction: then the segment's own counts.
    point.tangent = glm::normalize(glm::dot(tangent, tangent) < 1e-6 ? chord : tangent);
    point.radius = glm::mix(groom.points[i].w, groom.points[i + 1].w, static_cast<float>(at));
    const double parameter = glm::mix<double>(groom.parameter[i], groom.parameter[i + 1], at);
    const double along =
        std::clamp((parameter - groom.gradient_start) /
                       std::max(1.0 - static_cast<double>(groom.gradient_start), 1e-3),
                   0.0, 1.0);
    const glm::dvec3 gradient =
        glm::mix(glm::dvec3(groom.base_color), glm::dvec3(groom.tip_color), along);
    point.color = glm::clamp(gradient * glm::dvec3(groom.segment_tint[segment]), 0.0, 1.0);
    return point;
}

}  // namespace vellus::hair::tracer
