#include "modules/hair/reference/tracer/mesh_scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vellus::hair::tracer {

namespace {

constexpr double kPi = std::numbers::pi;

/// Orthonormal basis around a unit vector (Duff et al. 2017).
glm::dmat3 frame_around(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {
        {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

double ggx(double cos_h, double alpha) {
    const double a2 = alpha * alpha;
    const double d = cos_h * cos_h * (a2 - 1.0) + 1.0;
    return a2 / (kPi * d * d);
}

/// Smith's masking of one direction.
double masking(double cosine, double alpha) {
    const double a2 = alpha * alpha;
    return 2.0 * cosine / (cosine + std::sqrt(a2 + (1.0 - a2) * cosine * cosine));
}

/// A normal that the eye sees; Heitz 2018, listing 1.
glm::dvec3 sample_visible_normal(const glm::dvec3& eye, double alpha, const glm::dvec2& u) {
    const glm::dvec3 v = glm::normalize(glm::dvec3(alpha * eye.x, alpha * eye.y, eye.z));
    const double across = v.x * v.x + v.y * v.y;
    const glm::dvec3 t1 =
        across > 0.0 ? glm::dvec3(-v.y, v.x, 0.0) / std::sqrt(across) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 t2 = glm::cross(v, t1);
    const double r = std::sqrt(u.x);
    const double p1 = r * std::cos(2.0 * kPi * u.y);
    const double s = 0.5 * (1.0 + v.z);
    const double p2 =
        glm::mix(std::sqrt(std::max(1.0 - p1 * p1, 0.0)), r * std::sin(2.0 * kPi * u.y), s);
    const double p3 = std::sqrt(std::max(1.0 - p1 * p1 - p2 * p2, 0.0));
    const glm::dvec3 n = p1 * t1 + p2 * t2 + p3 * v;
    return glm::normalize(glm::dvec3(alpha * n.x, alpha * n.y, std::max(n.z, 1e-9)));
}

}  // namespace

MeshScattering::MeshScattering(const glsl::PbrSurface& surface, const glm::dvec3& normal,
                               const glm::dvec3& to_eye)
    : surface_(surface), normal_(normal), to_eye_(to_eye), frame_(frame_around(normal)) {
    eye_ = glm::transpose(frame_) * to_eye;
    // The shader takes |n·v| where interpolated normals turn away from the eye.
    eye_.z = std::max(std::abs(eye_.z), 1e-4);
    eye_ = glm::normalize(eye_);
    const double roughness = std::max(surface.roughness, 0.089f);
    alpha_ = roughness * roughness;
    const glm::dvec3 f0(glsl::pbr_f0(surface));
    const double fresnel = glm::mix((f0.x + f0.y + f0.z) / 3.0, 1.0, std::pow(1.0 - eye_.z, 5.0));
    const double diffuse = (1.0 - fresnel) * (1.0 - surface.metallic) *
                           (surface.base_color.x + surface.base_color.y + surface.base_color.z) /
                           3.0;
    mirror_share_ = std::clamp(fresnel / (fresnel + diffuse), 0.1, 0.9);
}

glm::dvec3 MeshScattering::evaluate(const glm::dvec3& to_light) const {
    return glm::dvec3(
        glsl::pbr_direct(surface_, glm::vec3(normal_), glm::vec3(to_light), glm::vec3(to_eye_)));
}

double MeshScattering::pdf(const glm::dvec3& to_light) const {
    const glm::dvec3 l = glm::transpose(frame_) * to_light;
    if (l.z <= 0.0) return 0.0;
    const glm::dvec3 sum = l + eye_;
    const double length = glm::length(sum);
    const double mirror =
        length > 0.0 ? masking(eye_.z, alpha_) * ggx(sum.z / length, alpha_) / (4.0 * eye_.z) : 0.0;
    return mirror_share_ * mirror + (1.0 - mirror_share_) * l.z / kPi;
}

MeshScattering::Sample MeshScattering::sample(const glm::dvec3& u) const {
    glm::dvec3 l;
    if (u.z < mirror_share_) {
        const glm::dvec3 h = sample_visible_normal(eye_, alpha_, {u.x, u.y});
        l = 2.0 * glm::dot(eye_, h) * h - eye_;
    } else {
        const double r = std::sqrt(u.x);
        l = {r * std::cos(2.0 * kPi * u.y), r * std::sin(2.0 * kPi * u.y),
             std::sqrt(std::max(1.0 - u.x, 0.0))};
    }
    Sample s;
    s.direction = glm::normalize(frame_ * l);
    s.pdf = pdf(s.direction);
    if (s.pdf > 0.0) s.weight = evaluate(s.direction) / s.pdf;
    return s;
}

}  // namespace vellus::hair::tracer
