#include "modules/hair/reference/chiang.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/hair/reference/dielectric.h"

namespace vellus::hair::reference {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMinVariance = 1e-6;
constexpr double kMinColor = 1e-37;
constexpr double kMinCosine = 1e-12;

/// The inclination turned by `angle` towards the tip, folded back past the axis.
Inclination turned(Inclination from, double angle) {
    const double sin = from.sin * std::cos(angle) + from.cos * std::sin(angle);
    const double cos = from.cos * std::cos(angle) - from.sin * std::sin(angle);
    return {sin, std::abs(cos)};
}

/// Logistic distribution function, without overflow on either side.
double logistic_cdf(double x, double s) {
    return 1.0 / (1.0 + std::exp(-x / s));
}

double sample_trimmed_logistic(double u, double s) {
    const double low = logistic_cdf(-kPi, s);
    const double share = low + u * std::tanh(0.5 * kPi / s);
    return std::clamp(-s * std::log(1.0 / share - 1.0), -kPi, kPi);
}

/// e^(-path σ), the same in every channel.
glm::dvec3 transmitted(const glm::dvec3& sigma, double path) {
    return glm::exp(-sigma * path);
}

}  // namespace

double trimmed_logistic(double phi, double s) {
    const double e = std::exp(-std::abs(phi) / s);
    return e / (s * (1.0 + e) * (1.0 + e) * std::tanh(0.5 * kPi / s));
}

ChiangFibre chiang_fibre(const glm::dvec3& sigma_a, double beta_m, double beta_n) {
    ChiangFibre fibre;
    fibre.sigma_a = sigma_a;
    const double root = 0.726 * beta_m + 0.812 * beta_m * beta_m + 3.7 * std::pow(beta_m, 20.0);
    const double v = std::max(root * root, kMinVariance);
    fibre.variance = {v, std::max(0.25 * v, kMinVariance), 4.0 * v, 4.0 * v};
    fibre.azimuthal_scale.fill(
        std::sqrt(kPi / 8.0) *
        std::max(0.265 * beta_n + 1.194 * beta_n * beta_n + 5.372 * std::pow(beta_n, 22.0), 1e-3));
    return fibre;
}

ChiangFibre chiang_from_karis(const glm::dvec3& base_color, double roughness, double tilt) {
    ChiangFibre fibre;
    fibre.sigma_a = -0.25 * glm::log(glm::clamp(base_color, kMinColor, 1.0));
    const double beta = roughness * roughness;
    const auto variance = [](double b) { return std::max(b * b, kMinVariance); };
    fibre.variance = {variance(beta), variance(0.5 * beta), variance(2.0 * beta),
                      variance(2.0 * beta)};
    fibre.azimuthal_scale = {0.1, kKarisScaleTt, kKarisScaleTrt};
    fibre.tilt = tilt;
    return fibre;
}

ChiangScattering::ChiangScattering(const ChiangFibre& fibre, double h, Inclination eye)
    : variance_(fibre.variance), scale_(fibre.azimuthal_scale) {
    const double offset = std::clamp(h, -1.0, 1.0);
    const double cos_o = std::max(eye.cos, kMinCosine);
    // Bravais: in the normal plane the fibre refracts by η′.
    const double eta_prime = std::sqrt(fibre.eta * fibre.eta - eye.sin * eye.sin) / cos_o;
    const double gamma_o = std::asin(offset);
    const double gamma_t = std::asin(offset / eta_prime);
    for (int p = 0; p < kChiangLobes - 1; ++p) {
        center_[p] = 2.0 * p * gamma_t - 2.0 * gamma_o + p * kPi;
    }
    // R against the scales, TT and TRT with them (Marschner et al. 2003, table 1).
    const std::array<double, kChiangLobes> turn = {2.0 * fibre.tilt, -fibre.tilt, -4.0 * fibre.tilt,
                                                   0.0};
    for (int p = 0; p < kChiangLobes; ++p) tilted_[p] = turned(eye, turn[p]);

    const double sin_t = eye.sin / fibre.eta;
    const double cos_t = std::sqrt(1.0 - sin_t * sin_t);
    const glm::dvec3 t = transmitted(fibre.sigma_a, 2.0 * std::cos(gamma_t) / cos_t);
    const double f = fresnel_dielectric(eye.cos * std::sqrt(1.0 - offset * offset), fibre.eta);
    const double in_out = (1.0 - f) * (1.0 - f);
    attenuation_[0] = glm::dvec3(f * fibre.specular);
    attenuation_[1] = t * in_out;
    attenuation_[2] = t * t * (in_out * f);
    for (int c = 0; c < 3; ++c) {
        // Σ over p >= 3; where nothing enters (f = 1) nothing comes out.
        const double kept = 1.0 - t[c] * f;
        attenuation_[3][c] = kept > 0.0 ? in_out * f * f * t[c] * t[c] * t[c] / kept : 0.0;
    }
    double sum = 0.0;
    for (int p = 0; p < kChiangLobes; ++p) {
        choice_[p] = attenuation_[p].x + attenuation_[p].y + attenuation_[p].z;
        sum += choice_[p];
    }
    for (double& probability : choice_) probability = sum > 0.0 ? probability / sum : 0.0;
}

glm::dvec3 ChiangScattering::albedo() const {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& a : attenuation_) sum += a;
    return sum;
}

double ChiangScattering::lobe(int p, Inclination i, double phi) const {
    const double m = longitudinal_deon(variance_[p], i, tilted_[p]);
    if (p == kChiangLobes - 1) return m * (0.5 / kPi);
    return m * trimmed_logistic(std::remainder(phi - center_[p], 2.0 * kPi), scale_[p]);
}

glm::dvec3 ChiangScattering::evaluate(Inclination i, double phi) const {
    glm::dvec3 sum(0.0);
    for (int p = 0; p < kChiangLobes; ++p) sum += attenuation_[p] * lobe(p, i, phi);
    return sum;
}

double ChiangScattering::pdf(Inclination i, double phi) const {
    double sum = 0.0;
    for (int p = 0; p < kChiangLobes; ++p) {
        if (choice_[p] > 0.0) sum += choice_[p] * lobe(p, i, phi);
    }
    return sum;
}

ChiangScattering::Sample ChiangScattering::sample(const glm::dvec4& u) const {
    int p = 0;
    double rest = u.x;
    while (p < kChiangLobes - 1 && rest >= choice_[p]) rest -= choice_[p++];
    while (p > 0 && choice_[p] <= 0.0) --p;  // rounding may step past the last possible lobe
    if (choice_[p] <= 0.0) return {};

    // d'Eon et al. 2013, "Importance sampling for physically-based hair fiber models", section 3:
    // 1 - cos of a von Mises-Fisher lobe around the mirrored inclination, then a turn around it.
    const double v = variance_[p];
    const double drop = -v * std::log(1.0 - u.y + u.y * std::exp(-2.0 / v));
    const double cosine = 1.0 - drop;
    const double sine = std::sqrt(std::max(drop * (2.0 - drop), 0.0));
    const Inclination o = tilted_[p];
    Sample s;
    s.i.sin = std::clamp(-cosine * o.sin + sine * std::cos(2.0 * kPi * u.z) * o.cos, -1.0, 1.0);
    s.i.cos = std::sqrt(1.0 - s.i.sin * s.i.sin);
    s.phi = p == kChiangLobes - 1
                ? 2.0 * kPi * (u.w - 0.5)
                : std::remainder(center_[p] + sample_trimmed_logistic(u.w, scale_[p]), 2.0 * kPi);
    s.pdf = pdf(s.i, s.phi);
    if (s.pdf > 0.0) s.weight = evaluate(s.i, s.phi) / s.pdf;
    return s;
}

}  // namespace vellus::hair::reference
