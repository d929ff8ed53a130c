#include "modules/hair/reference/karis_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/hair/reference/longitudinal.h"

namespace vellus::hair::reference {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMinBeta = 1e-3;

/// Inclinations, difference angle and azimuth of a light path, in radians.
struct Angles {
    double theta_i;
    double theta_r;
    double theta_d;
    double phi;
    double cos_between;
};

Angles angles_of(const glm::dvec3& u, const glm::dvec3& wi, const glm::dvec3& wr) {
    const glm::dvec3 across_i = wi - u * glm::dot(u, wi);
    const glm::dvec3 across_r = wr - u * glm::dot(u, wr);
    Angles a{};
    a.theta_i = std::asin(std::clamp(glm::dot(u, wi), -1.0, 1.0));
    a.theta_r = std::asin(std::clamp(glm::dot(u, wr), -1.0, 1.0));
    a.theta_d = 0.5 * (a.theta_r - a.theta_i);
    // atan2 of cross and dot product is exact near 0 and π, where acos is not.
    a.phi = std::atan2(glm::length(glm::cross(across_i, across_r)), glm::dot(across_i, across_r));
    a.cos_between = std::clamp(glm::dot(wi, wr), -1.0, 1.0);
    return a;
}

double fresnel(double x) {
    constexpr double eta = 1.55;
    constexpr double f0 = (1.0 - eta) * (1.0 - eta) / ((1.0 + eta) * (1.0 + eta));
    return f0 + (1.0 - f0) * std::pow(1.0 - x, 5.0);
}

/// C to a power, with 0^0 = 0: black absorbs everything.
glm::dvec3 absorb(const glm::dvec3& c, double power) {
    glm::dvec3 t(0.0);
    for (int i = 0; i < 3; ++i) t[i] = c[i] > 0.0 ? std::pow(c[i], power) : 0.0;
    return t;
}

double r_lobe(const glsl::HairSurface& s, const Angles& a, const KarisVariant& variant) {
    const double tilt = -std::asin(static_cast<double>(s.shift));
    const double cos_half = std::cos(0.5 * a.phi);
    const double beta =
        std::max(static_cast<double>(s.roughness) * s.roughness, kMinBeta) + variant.added_beta;
    const double width = beta * std::numbers::sqrt2 * cos_half;
    const double alpha =
        2.0 * std::sin(tilt) *
        (std::cos(tilt) * cos_half * std::cos(a.theta_r) + std::sin(tilt) * std::sin(a.theta_r));
    const double m = longitudinal_gaussian(width, std::sin(a.theta_i) + std::sin(a.theta_r), alpha);
    const double attenuation = fresnel(std::sqrt(0.5 + 0.5 * a.cos_between));
    const double occlusion = variant.occlude_r ? std::clamp(a.cos_between + 1.0, 0.0, 1.0) : 1.0;
    return m * 0.25 * cos_half * attenuation * occlusion * 2.0 * s.specular;
}

glm::dvec3 tt_lobe(const glsl::HairSurface& s, const Angles& a, const KarisVariant& variant) {
    const double beta = std::max(0.5 * static_cast<double>(s.roughness) * s.roughness, kMinBeta) +
                        variant.added_beta;
    const double cos_d = std::cos(a.theta_d);
    const double eta_prime = 1.19 / cos_d + 0.36 * cos_d;
    const double inverse = 1.0 / eta_prime;
    const double h = (1.0 + inverse * (0.6 - 0.8 * std::cos(a.phi))) * std::cos(0.5 * a.phi);
    const double h2 = std::min(h * h, 1.0);
    const double f = fresnel(cos_d * std::sqrt(1.0 - h2));
    const glm::dvec3 t =
        absorb(s.base_color, std::sqrt(1.0 - h2 * inverse * inverse) / (2.0 * cos_d));
    const double n = std::exp(-3.65 * std::cos(a.phi) - 3.98);
    const double m =
        longitudinal_gaussian(beta, std::sin(a.theta_i) + std::sin(a.theta_r), s.shift);
    return t * (m * n * (1.0 - f) * (1.0 - f));
}

glm::dvec3 trt_lobe(const glsl::HairSurface& s, const Angles& a, const KarisVariant& variant) {
    const double beta = std::max(2.0 * static_cast<double>(s.roughness) * s.roughness, kMinBeta) +
                        variant.added_beta;
    const double h = 0.5 * std::numbers::sqrt3;
    const double f = fresnel(std::cos(a.theta_d) * std::sqrt(1.0 - h * h));
    const glm::dvec3 t = absorb(s.base_color, 0.8 / std::cos(a.theta_d));
    const double n = std::exp(17.0 * std::cos(a.phi) - 16.78);
    const double m =
        longitudinal_gaussian(beta, std::sin(a.theta_i) + std::sin(a.theta_r), 4.0 * s.shift);
    return t * (m * n * (1.0 - f) * (1.0 - f) * f);
}

glm::dvec3 scattering_term(const glsl::HairSurface& s, const glm::dvec3& u, const glm::dvec3& wi,
                           const glm::dvec3& wr, double shadow) {
    const glm::dvec3 n = glm::normalize(wr - u * glm::dot(u, wr));
    const glm::dvec3 c = s.base_color;
    const double luma = glm::dot(c, glm::dvec3(0.3, 0.59, 0.11));
    if (luma <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 tint = glm::pow(c / luma, glm::dvec3(1.0 - shadow));
    return glm::sqrt(c) * tint * ((glm::dot(n, wi) + 1.0) / (4.0 * kPi) * s.scatter);
}

}  // namespace

KarisTerms karis_terms(const glsl::HairSurface& surface, const glm::dvec3& tangent,
                       const glm::dvec3& to_light, const glm::dvec3& to_view, double shadow,
                       const KarisVariant& variant) {
    const Angles a = angles_of(tangent, to_light, to_view);
    KarisTerms terms{};
    terms.r = glm::dvec3(r_lobe(surface, a, variant));
    if (variant.with_tt) terms.tt = tt_lobe(surface, a, variant);
    terms.trt = trt_lobe(surface, a, variant);
    terms.scattering = scattering_term(surface, tangent, to_light, to_view, shadow);
    return terms;
}

}  // namespace vellus::hair::reference
