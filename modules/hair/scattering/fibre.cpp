#include "modules/hair/scattering/fibre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace vellus::hair {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kDegrees = 3;  // of the quadratics in u
constexpr size_t kMostTerms = 8;
constexpr int kOffsets = 64;  // midpoints in γi over a quarter turn
constexpr int kGrazes = 20;   // cos θd of the fit, Chebyshev nodes in [0, 1]
constexpr std::array<double, 8> kColors = {1e-3, 1e-2, 0.03, 0.1, 0.25, 0.5, 0.8, 1.0};

/// Least squares A x = B for several right sides, by Householder reflections. Row-major; A and B
/// are destroyed, the solution is in the first `columns` rows of B.
struct LeastSquares {
    size_t columns;
    size_t sides;
    std::vector<double> a;
    std::vector<double> b;

    [[nodiscard]] size_t rows() const { return a.size() / columns; }

    void reflect(size_t pivot, const std::vector<double>& v, double scale,
                 std::vector<double>& matrix, size_t width, size_t first) const {
        for (size_t j = first; j < width; ++j) {
            double dot = 0.0;
            for (size_t r = pivot; r < rows(); ++r) dot += v[r] * matrix[r * width + j];
            dot *= scale;
            for (size_t r = pivot; r < rows(); ++r) matrix[r * width + j] -= dot * v[r];
        }
    }

    void solve() {
        std::vector<double> v(rows());
        for (size_t c = 0; c < columns; ++c) {
            double norm = 0.0;
            for (size_t r = c; r < rows(); ++r) {
                v[r] = a[r * columns + c];
                norm += v[r] * v[r];
            }
            norm = std::sqrt(norm);
            v[c] += v[c] > 0.0 ? norm : -norm;
            double squared = 0.0;
            for (size_t r = c; r < rows(); ++r) squared += v[r] * v[r];
            if (squared == 0.0) continue;
            reflect(c, v, 2.0 / squared, a, columns, c);
            reflect(c, v, 2.0 / squared, b, sides, 0);
        }
        for (size_t j = 0; j < sides; ++j) {
            for (size_t c = columns; c-- > 0;) {
                double value = b[c * sides + j];
                for (size_t e = c + 1; e < columns; ++e) {
                    value -= a[c * columns + e] * b[e * sides + j];
                }
                b[c * sides + j] = value / a[c * columns + c];
            }
        }
    }
};

double fresnel(double index2_1, double cosine) {
    const double g = std::sqrt(index2_1 + cosine * cosine);
    const double s = (cosine - g) / (cosine + g);
    const double p = ((index2_1 + 1.0) * cosine - g) / ((index2_1 + 1.0) * cosine + g);
    return 0.5 * (s * s + p * p);
}

/// Series of one lobe at one cos θd: 2 c_k (c_0 once) for each colour, colour by colour.
void lobe_series(const FibreOptics& optics, int p, double width, double cos_d, size_t count,
                 std::vector<double>& series) {
    const double index2 = static_cast<double>(optics.eta) * optics.eta;
    const double inverse = cos_d / std::sqrt(index2 - 1.0 + cos_d * cos_d);
    const double cos_t = std::sqrt(1.0 - (1.0 - cos_d * cos_d) / index2);
    series.assign(count * kColors.size(), 0.0);
    for (int i = 0; i < kOffsets; ++i) {
        const double gamma = 0.5 * kPi * (i + 0.5) / kOffsets;
        const double sin_t = std::sin(gamma) * inverse;
        const double azimuth = 2.0 * p * std::asin(sin_t) - 2.0 * gamma + p * kPi;
        const double reflected = fresnel(index2 - 1.0, cos_d * std::cos(gamma));
        const double weight = 0.5 * kPi / kOffsets * std::cos(gamma) / (2.0 * kPi) *
                              (1.0 - reflected) * (1.0 - reflected) * (p == 2 ? reflected : 1.0);
        const double chord = 2.0 * p * std::sqrt(1.0 - sin_t * sin_t) / cos_t;
        std::array<double, kMostTerms> wave{1.0, std::cos(azimuth)};
        for (size_t k = 2; k < count; ++k) wave[k] = 2.0 * wave[1] * wave[k - 1] - wave[k - 2];
        for (size_t c = 0; c < kColors.size(); ++c) {
            const double passed = weight * std::exp(0.25 * chord * std::log(kColors[c]));
            for (size_t k = 0; k < count; ++k) series[c * count + k] += passed * wave[k];
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double damped = std::exp(-0.5 * static_cast<double>(k * k) * width * width);
        for (size_t c = 0; c < kColors.size(); ++c) {
            series[c * count + k] *= damped * (k == 0 ? 1.0 : 2.0);
        }
    }
}

/// Coefficients by path, degree, then k.
std::vector<double> fit_lobe(const FibreOptics& optics, int p, double width, size_t count,
                             const std::vector<double>& paths) {
    LeastSquares fit{.columns = paths.size() * kDegrees, .sides = count, .a = {}, .b = {}};
    std::vector<double> series;
    for (int i = 0; i < kGrazes; ++i) {
        const double x = 0.5 - 0.5 * std::cos(kPi * (i + 0.5) / kGrazes);
        lobe_series(optics, p, width, x, count, series);
        const double index2 = static_cast<double>(optics.eta) * optics.eta;
        const double cos_t = std::sqrt(1.0 - (1.0 - x * x) / index2);
        const double u = x / (x + glsl::kGrazing);
        const double largest = p == 1 ? 0.1 : 0.01;
        for (size_t c = 0; c < kColors.size(); ++c) {
            const double weight = 1.0 / (series[c * count] + 0.01 * largest);
            for (const double path : paths) {
                double value = weight * u * u * std::pow(kColors[c], 0.5 * p * path / cos_t);
                for (int d = 0; d < kDegrees; ++d, value *= u) fit.a.push_back(value);
            }
            for (size_t k = 0; k < count; ++k) fit.b.push_back(weight * series[c * count + k]);
        }
    }
    fit.solve();
    fit.b.resize(fit.columns * count);
    return fit.b;
}

/// ∫ N |φ|/π dφ of a series whose terms carry their 2, π c_0 - 4/π Σ over odd k of 2 c_k / k², and
/// the rest.
glm::dvec2 shares(std::span<const double> series) {
    double forward = kPi * series[0];
    for (size_t k = 1; k < series.size(); k += 2) {
        forward -= 4.0 / kPi * series[k] / static_cast<double>(k * k);
    }
    return {forward, 2.0 * kPi * series[0] - forward};
}

/// Shares of R, ¼ |cos φ/2| F, as cubics in u.
void fit_reflection(const FibreOptics& optics, glsl::HairFibre& fibre) {
    LeastSquares fit{.columns = 4, .sides = 2, .a = {}, .b = {}};
    for (int i = 0; i < kGrazes; ++i) {
        const double x = 0.5 - 0.5 * std::cos(kPi * (i + 0.5) / kGrazes);
        const double u = x / (x + glsl::kGrazing);
        double forward = 0.0;
        double all = 0.0;
        for (int j = 0; j < kOffsets; ++j) {
            const double gamma = 0.5 * kPi * (j + 0.5) / kOffsets;  // φ = 2 γ
            const double f =
                fresnel(static_cast<double>(optics.eta) * optics.eta - 1.0, x * std::cos(gamma)) *
                std::cos(gamma) * 0.5 * kPi / kOffsets;
            forward += f * 2.0 * gamma / kPi;
            all += f;
        }
        const double weight = 1.0 / all;
        for (const double power : {1.0, u, u * u, u * u * u}) fit.a.push_back(weight * power);
        fit.b.push_back(weight * forward);
        fit.b.push_back(weight * (all - forward));
    }
    fit.solve();
    for (int d = 0; d < 4; ++d) {
        fibre.r_forward[d] = static_cast<float>(fit.b[d * 2]);
        fibre.r_backward[d] = static_cast<float>(fit.b[d * 2 + 1]);
    }
}

}  // namespace

void fit_azimuthal(const FibreOptics& given, glsl::HairFibre& fibre) {
    const FibreOptics optics{.eta = std::clamp(given.eta, 1.1f, 3.0f),
                             .detector_tt = std::clamp(given.detector_tt, 0.1f, 2.0f),
                             .detector_trt = std::clamp(given.detector_trt, 0.1f, 2.0f)};
    fibre.index2_1 = optics.eta * optics.eta - 1.0f;
    fibre.inverse_index2 = 1.0f / (optics.eta * optics.eta);
    fibre.detector_tt = optics.detector_tt;
    fibre.detector_trt = optics.detector_trt;
    const auto tt = fit_lobe(optics, 1, optics.detector_tt, 4, {glsl::kPathShort, glsl::kPathLong});
    for (size_t row = 0; row < 6; ++row) {
        for (int k = 0; k < 4; ++k) fibre.tt[row][k] = static_cast<float>(tt[row * 4 + k]);
    }
    for (size_t row = 0; row < 6; ++row) {
        const auto share = shares(std::span(tt).subspan(row * 4, 4));
        fibre.forward[row / 3][static_cast<int>(row % 3)] = static_cast<float>(share.x);
        fibre.backward[row / 3][static_cast<int>(row % 3)] = static_cast<float>(share.y);
    }
    const auto trt =
        fit_lobe(optics, 2, optics.detector_trt, 8, {0.5 * (glsl::kPathShort + glsl::kPathLong)});
    for (size_t degree = 0; degree < 3; ++degree) {
        for (int k = 0; k < 8; ++k) {
            fibre.trt[degree + (k < 4 ? 0 : 3)][k % 4] = static_cast<float>(trt[degree * 8 + k]);
        }
        const auto share = shares(std::span(trt).subspan(degree * 8, 8));
        fibre.forward[2][static_cast<int>(degree)] = static_cast<float>(share.x);
        fibre.backward[2][static_cast<int>(degree)] = static_cast<float>(share.y);
    }
    fit_reflection(optics, fibre);
}

void set_longitudinal(float roughness, float shift, glsl::HairFibre& fibre) {
    const double r2 = static_cast<double>(roughness) * roughness;
    const std::array<double, 3> beta = {r2, 0.5 * r2, 2.0 * r2};
    const std::array<double, 3> turn = {-2.0, 1.0, 4.0};
    const double tilt = std::asin(std::clamp(static_cast<double>(shift), -1.0, 1.0));
    for (int p = 0; p < 3; ++p) {
        const double b = std::max(beta[p], static_cast<double>(glsl::kHairMinBeta));
        const double v = b * b;
        fibre.inverse_v[p] = static_cast<float>(1.0 / v);
        fibre.peak[p] = static_cast<float>(1.0 / (v * -std::expm1(-2.0 / v)));
        fibre.sin_tilt[p] = static_cast<float>(std::sin(turn[p] * tilt));
        fibre.cos_tilt[p] = static_cast<float>(std::cos(turn[p] * tilt));
    }
}

}  // namespace vellus::hair
