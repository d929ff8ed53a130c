#include "modules/hair/reference/marschner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "modules/hair/reference/longitudinal.h"

namespace vellus::hair::reference {

namespace {

constexpr double kPi = std::numbers::pi;

/// dΦ/dγi · cos γt: free of the poles of dΦ/dh at |h| = 1.
double azimuth_slope(int p, double modified, double gamma_i) {
    const double h = std::sin(gamma_i);
    const double cos_t = std::sqrt(1.0 - h * h / (modified * modified));
    return 2.0 * p * std::cos(gamma_i) / (modified * cos_t) - 2.0;
}

/// |h| where Φ turns round (p >= 2 and η' < p), else 1.
double caustic_offset(int p, double modified) {
    if (p < 2 || modified >= p) return 1.0;
    return std::sqrt((p * p - modified * modified) / (p * p - 1.0));
}

/// The γi in [low, high], where Φ is monotone, with Φ = target; bisection to the last bit.
bool solve(int p, double modified, double low, double high, double target, double& gamma) {
    const auto miss = [&](double g) { return exit_azimuth(p, modified, std::sin(g)) - target; };
    double at_low = miss(low);
    const double at_high = miss(high);
    if (at_low * at_high > 0.0) return false;
    for (int step = 0; step < 80; ++step) {
        gamma = 0.5 * (low + high);
        const double value = miss(gamma);
        if ((value > 0.0) == (at_low > 0.0) && value != 0.0) {
            low = gamma;
            at_low = value;
        } else {
            high = gamma;
        }
    }
    return true;
}

std::vector<double> incidences_of_azimuth(int p, double modified, double phi) {
    std::vector<double> found;
    const double caustic = std::asin(caustic_offset(p, modified));
    std::vector<double> edges = {-0.5 * kPi, 0.5 * kPi};
    if (caustic < 0.5 * kPi) edges = {-0.5 * kPi, -caustic, caustic, 0.5 * kPi};
    const int turns = p + 2;
    for (size_t piece = 0; piece + 1 < edges.size(); ++piece) {
        for (int turn = -turns; turn <= turns; ++turn) {
            double gamma = 0.0;
            if (solve(p, modified, edges[piece], edges[piece + 1], phi + 2.0 * kPi * turn, gamma)) {
                const bool known = std::ranges::any_of(
                    found, [&](double other) { return std::abs(other - gamma) < 1e-12; });
                if (!known) found.push_back(gamma);
            }
        }
    }
    return found;
}

/// Φ'' at the caustic, in h.
double azimuth_curvature(int p, double modified, double h) {
    const double inside = modified * modified - h * h;
    const double outside = 1.0 - h * h;
    return 2.0 * p * h / (inside * std::sqrt(inside)) - 2.0 * h / (outside * std::sqrt(outside));
}

}  // namespace

double marschner_fresnel(double eta, double theta_d, double gamma_i) {
    const double sin_d = std::sin(theta_d);
    const double cos_d = std::max(std::abs(std::cos(theta_d)), 1e-300);
    const double root = std::sqrt(eta * eta - sin_d * sin_d);
    const double c = std::cos(gamma_i);
    const double s2 = 1.0 - c * c;
    const auto reflect = [&](double index, bool parallel) {
        const double inside2 = 1.0 - s2 / (index * index);
        if (inside2 <= 0.0) return 1.0;
        const double inside = std::sqrt(inside2);
        const double r = parallel ? (index * c - inside) / (index * c + inside)
                                  : (c - index * inside) / (c + index * inside);
        return r * r;
    };
    return 0.5 * (reflect(root / cos_d, false) + reflect(eta * eta * cos_d / root, true));
}

double marschner_attenuation(const Fibre& fibre, int p, double theta_d, double h) {
    const double f = marschner_fresnel(fibre.eta, theta_d, std::asin(std::clamp(h, -1.0, 1.0)));
    if (p == 0) return f * fibre.reflection;
    const double sin_t = std::sin(theta_d) / fibre.eta;
    const double gamma = h / modified_index(fibre.eta, theta_d);
    const double chord = 2.0 * std::sqrt((1.0 - gamma * gamma) / (1.0 - sin_t * sin_t));
    return (1.0 - f) * (1.0 - f) * std::pow(f, p - 1) * std::exp(-fibre.absorption * chord * p);
}

std::vector<double> offsets_of_azimuth(int p, double modified, double phi) {
    std::vector<double> offsets = incidences_of_azimuth(p, modified, phi);
    for (double& value : offsets) value = std::sin(value);
    return offsets;
}

double marschner_azimuthal(const Fibre& fibre, int p, double theta_d, double phi) {
    const double modified = modified_index(fibre.eta, theta_d);
    double sum = 0.0;
    for (const double gamma : incidences_of_azimuth(p, modified, phi)) {
        const double slope = std::abs(azimuth_slope(p, modified, gamma));
        const double a = marschner_attenuation(fibre, p, theta_d, std::sin(gamma));
        sum += a * std::cos(gamma) / std::max(slope, std::numeric_limits<double>::min());
    }
    return 0.5 * sum;
}

double marschner_trt(const Fibre& fibre, double theta_d, double phi, const MarschnerGlint& glint) {
    const double modified = modified_index(fibre.eta, theta_d);
    double caustic_phi = 0.0;
    double h = 0.0;
    double offset = glint.most_offset;
    double fade = 1.0;
    if (modified < 2.0) {
        h = caustic_offset(2, modified);
        caustic_phi = std::remainder(exit_azimuth(2, modified, h), 2.0 * kPi);
        const double curvature = std::abs(azimuth_curvature(2, modified, h));
        offset = std::min(offset, 2.0 * std::sqrt(2.0 * glint.width / curvature));
    } else {
        const double x = std::clamp((modified - 2.0) / glint.fade, 0.0, 1.0);
        fade = 1.0 - x * x * (3.0 - 2.0 * x);
    }
    const auto gaussian = [&](double center) {
        const double x = std::remainder(phi - center, 2.0 * kPi) / glint.width;
        return std::exp(-0.5 * x * x);
    };
    const double left = gaussian(caustic_phi);
    const double right = gaussian(-caustic_phi);
    double lobe = std::min(marschner_azimuthal(fibre, 2, theta_d, phi), 1e12);
    lobe *= (1.0 - fade * left) * (1.0 - fade * right);
    const double peak = 1.0 / (glint.width * std::sqrt(2.0 * kPi));
    return lobe + fade * glint.scale * marschner_attenuation(fibre, 2, theta_d, h) * offset * peak *
                      (left + right);
}

double marschner(const Fibre& fibre, double theta_i, double theta_r, double phi,
                 const MarschnerGlint& glint) {
    const double theta_d = 0.5 * (theta_r - theta_i);
    const double theta_h = 0.5 * (theta_r + theta_i);
    const double cos_d = std::max(std::abs(std::cos(theta_d)), 1e-8);
    double sum = 0.0;
    for (int p = 0; p < 3; ++p) {
        const double m =
            0.5 * longitudinal_gaussian(0.5 * fibre.beta[p], theta_h, 0.5 * fibre.tilt[p]);
        const double n = p == 2 ? marschner_trt(fibre, theta_d, phi, glint)
                                : marschner_azimuthal(fibre, p, theta_d, phi);
        sum += m * n;
    }
    return sum * std::abs(std::cos(theta_i)) / (cos_d * cos_d);
}

}  // namespace vellus::hair::reference
