#include "modules/hair/reference/chiang.h"
#include "modules/hair/reference/fibre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "modules/hair/reference/dielectric.h"
#include "tests/support/sampling.h"

namespace vellus::hair::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

Inclination inclined(double degrees) {
    return {std::sin(degrees * kDegree), std::cos(degrees * kDegree)};
}

/// ∫ f over the sphere of light directions. Midpoint rule in inclination, where it is exact to many
/// digits for lobes wider than a few steps, times the trapezoid rule around the fibre.
glm::dvec3 integrate(const std::function<glm::dvec3(Inclination, double)>& f, int inclinations,
                     int azimuths) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < inclinations; ++i) {
        const double theta = kPi * ((i + 0.5) / inclinations - 0.5);
        const Inclination at{std::sin(theta), std::cos(theta)};
        for (int j = 0; j < azimuths; ++j) {
            sum += f(at, 2.0 * kPi * (j + 0.5) / azimuths) * at.cos;
        }
    }
    return sum * (kPi / inclinations) * (2.0 * kPi / azimuths);
}

/// A rule of another kind: a rank-1 lattice (Kronecker, R2) over cylinder coordinates of equal
/// area.
glm::dvec3 integrate_lattice(const std::function<glm::dvec3(Inclination, double)>& f, int points) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < points; ++i) {
        const double sin = 2.0 * std::fmod(0.5 + 0.7548776662466927 * i, 1.0) - 1.0;
        const double phi = 2.0 * kPi * std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
        sum += f({sin, std::sqrt(1.0 - sin * sin)}, phi);
    }
    return sum * (4.0 * kPi / points);
}

TEST(Chiang, WhiteFurnaceKeepsAllEnergyAtEveryRoughnessAndInclination) {
    for (const double roughness : {0.1, 0.2, 0.4, 0.7, 1.0}) {
        for (const double degrees : {0.0, 30.0, 60.0, 85.0}) {
            for (const double h : {-0.93, 0.0, 0.5}) {
                ChiangFibre fibre = chiang_fibre(glm::dvec3(0.0), roughness, roughness);
                fibre.tilt = 0.035;
                const ChiangScattering s(fibre, h, inclined(degrees));
                const auto f = [&](Inclination i, double phi) { return s.evaluate(i, phi); };
                // The narrowest lobe (TT at 0.1) has a standard deviation of .04 in inclination and
                // .044 in azimuth: six steps and more; at 0.2 twice that.
                const int fine = roughness < 0.15 ? 2 : 1;
                EXPECT_NEAR(integrate(f, 240 * fine, 450 * fine).x, 1.0, 0.005)
                    << "roughness " << roughness << ", θ " << degrees << ", h " << h;
            }
        }
    }
}

TEST(Chiang, TwoQuadraturesAgreeWithTheSumOfTheLobes) {
    const glm::dvec3 sigma(0.05, 0.4, 1.5);
    for (const double degrees : {0.0, 50.0, 80.0}) {
        for (const double h : {-0.6, 0.2, 0.99}) {
            const ChiangScattering s(chiang_fibre(sigma, 0.5, 0.4), h, inclined(degrees));
            const auto f = [&](Inclination i, double phi) { return s.evaluate(i, phi); };
            const glm::dvec3 product = integrate(f, 400, 400);
            const glm::dvec3 lattice = integrate_lattice(f, 200'000);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(product[c], s.albedo()[c], 1e-4);
                // The lattice converges like log² n / n times the variation of f.
                EXPECT_NEAR(lattice[c], s.albedo()[c], 2e-3);
            }
        }
    }
}

/// One smooth fibre of radius 1 along x, traced with refraction vectors: no inclinations, no η′.
struct TracedPath {
    glm::dvec3 leaves{0.0};  // direction
    double inside = 0.0;     // length travelled in the fibre
    double reflectance = 0.0;
};

glm::dvec3 normal_at(const glm::dvec3& p) {
    return {0.0, p.y, p.z};
}

TracedPath trace(const glm::dvec3& to_eye, const glm::dvec3& at, int p, double eta) {
    const glm::dvec3 n = normal_at(at);
    TracedPath path;
    path.reflectance = fresnel_dielectric(glm::dot(n, to_eye), eta);
    if (p == 0) {
        path.leaves = 2.0 * glm::dot(n, to_eye) * n - to_eye;
        return path;
    }
    glm::dvec3 point = at;
    glm::dvec3 d = glm::refract(-to_eye, n, 1.0 / eta);
    for (int bounce = 0;; ++bounce) {
        const glm::dvec3 across(0.0, d.y, d.z);
        const double t =
            -2.0 * glm::dot(glm::dvec3(0.0, point.y, point.z), across) / glm::dot(across, across);
        path.inside += t;
        point += t * d;
        const glm::dvec3 inner = -normal_at(point);
        if (bounce == p - 1) {
            path.leaves = glm::refract(d, inner, eta);
            return path;
        }
        d = glm::reflect(d, inner);
    }
}

TEST(Chiang, PathsAreThoseOfRaysTracedThroughACylinder) {
    const double eta = 1.55;
    ChiangFibre fibre = chiang_fibre(glm::dvec3(0.3), 0.2, 0.2);
    fibre.eta = eta;
    for (const double degrees : {-70.0, -20.0, 0.0, 45.0}) {
        for (const double gamma : {-1.2, -0.4, 0.0, 0.7, 1.4}) {
            const Inclination o = inclined(degrees);
            const glm::dvec3 to_eye(o.sin, o.cos, 0.0);  // azimuth 0 is +y, counter-clockwise to +z
            // γo runs from the normal to the eye, so the normal lies at azimuth -γo.
            const glm::dvec3 at(0.0, std::cos(gamma), -std::sin(gamma));
            const ChiangScattering s(fibre, std::sin(gamma), o);
            const double f = fresnel_dielectric(glm::dot(normal_at(at), to_eye), eta);
            std::array<double, 3> share = {f, (1 - f) * (1 - f), (1 - f) * (1 - f) * f};
            double before = 0.0;
            double sum = 0.0;
            for (const glm::dvec3& a : s.attenuation()) sum += a.x;
            for (int p = 0; p < 3; ++p) {
                const TracedPath path = trace(to_eye, at, p, eta);
                EXPECT_NEAR(s.attenuation()[p].x, share[p] * std::exp(-0.3 * path.inside), 1e-12);
                // The middle of the lobe: u picks it, its inclination's peak and azimuth's centre.
                const double pick = before + 0.5 * s.attenuation()[p].x / sum;
                before += s.attenuation()[p].x / sum;
                const auto middle = s.sample({pick, 0.0, 0.0, 0.5});
                EXPECT_NEAR(middle.i.sin, path.leaves.x, 1e-9);
                const double azimuth = std::atan2(path.leaves.z, path.leaves.y);
                EXPECT_NEAR(std::remainder(middle.phi - azimuth, 2.0 * kPi), 0.0, 1e-7)
                    << "p " << p << ", θ " << degrees << ", γ " << gamma;
            }
        }
    }
}

TEST(Chiang, TiltShiftsTheLobesAsInTheShader) {
    ChiangFibre fibre = chiang_fibre(glm::dvec3(0.0), 0.2, 0.3);
    fibre.tilt = 0.05;
    const double theta_o = 0.3;
    const ChiangScattering s(fibre, 0.3, {std::sin(theta_o), std::cos(theta_o)});
    const std::array<double, 3> shift = {-2.0 * fibre.tilt, fibre.tilt, 4.0 * fibre.tilt};
    double before = 0.0;
    for (int p = 0; p < 3; ++p) {
        const auto middle = s.sample({before + 0.5 * s.attenuation()[p].x, 0.0, 0.0, 0.5});
        before += s.attenuation()[p].x;
        EXPECT_NEAR(std::asin(middle.i.sin) + theta_o, shift[p], 1e-9);
    }
}

TEST(Chiang, WeightsAverageToTheAlbedoAndStayBounded) {
    for (const double roughness : {0.1, 0.4, 1.0}) {
        for (const double degrees : {0.0, 70.0}) {
            const ChiangScattering s(chiang_fibre(glm::dvec3(0.02, 0.3, 2.0), roughness, roughness),
                                     0.4, inclined(degrees));
            constexpr int kSamples = 20'000;
            glm::dvec3 sum(0.0);
            glm::dvec3 squares(0.0);
            const glm::dvec3 albedo = s.albedo();
            const double bound = albedo.x + albedo.y + albedo.z;
            for (int i = 0; i < kSamples; ++i) {
                test::Random random(1, i);
                const auto sample =
                    s.sample({random.unit(), random.unit(), random.unit(), random.unit()});
                ASSERT_GT(sample.pdf, 0.0);
                // f_c / pdf <= max over p of A_pc / P(p), and P(p) >= A_pc / Σ albedo.
                for (int c = 0; c < 3; ++c) ASSERT_LE(sample.weight[c], bound * (1.0 + 1e-12));
                sum += sample.weight;
                squares += sample.weight * sample.weight;
            }
            for (int c = 0; c < 3; ++c) {
                const double mean = sum[c] / kSamples;
                const double error =
                    std::sqrt(std::max(squares[c] / kSamples - mean * mean, 0.0) / kSamples);
                EXPECT_NEAR(mean, albedo[c], 4.5 * error + 1e-9);
            }
        }
    }
}

TEST(Chiang, SamplesFallWhereThePdfSays) {
    constexpr int kRows = 20;
    constexpr int kColumns = 24;
    constexpr int kInner = 24;
    constexpr int kSamples = 400'000;
    ChiangFibre fibre = chiang_fibre(glm::dvec3(0.1), 0.35, 0.3);
    fibre.tilt = -0.06;
    const ChiangScattering s(fibre, -0.55, inclined(40.0));
    std::array<double, size_t{kRows} * kColumns> counted{};
    std::array<double, size_t{kRows} * kColumns> expected{};
    for (int i = 0; i < kSamples; ++i) {
        test::Random random(2, i);
        const auto sample = s.sample({random.unit(), random.unit(), random.unit(), random.unit()});
        const int row = std::min(static_cast<int>((sample.i.sin + 1.0) * 0.5 * kRows), kRows - 1);
        const double turn = sample.phi / (2.0 * kPi) + 0.5;
        const int column = std::clamp(static_cast<int>(turn * kColumns), 0, kColumns - 1);
        counted[row * kColumns + column] += 1.0;
    }
    for (int row = 0; row < kRows * kInner; ++row) {
        const double sin = 2.0 * (row + 0.5) / (kRows * kInner) - 1.0;
        for (int column = 0; column < kColumns * kInner; ++column) {
            const double phi = 2.0 * kPi * ((column + 0.5) / (kColumns * kInner) - 0.5);
            expected[row / kInner * kColumns + column / kInner] +=
                s.pdf({sin, std::sqrt(1.0 - sin * sin)}, phi);
        }
    }
    const double cell = 4.0 * kPi / (double{kRows} * kColumns * kInner * kInner) * kSamples;
    double chi2 = 0.0;
    double rest_expected = 0.0;
    double rest_counted = 0.0;
    int freedom = 0;
    for (size_t i = 0; i < counted.size(); ++i) {
        const double e = expected[i] * cell;
        if (e < 10.0) {
            rest_expected += e;
            rest_counted += counted[i];
            continue;
        }
        chi2 += (counted[i] - e) * (counted[i] - e) / e;
        ++freedom;
    }
    // χ² has mean k and variance 2 k; five deviations are passed by chance once in some 1e6 seeds.
    EXPECT_LT(chi2, freedom + 5.0 * std::sqrt(2.0 * freedom));
    EXPECT_GT(freedom, 100);
    EXPECT_NEAR(rest_counted, rest_expected, 5.0 * std::sqrt(rest_expected) + 1.0);
}

TEST(Chiang, EdgeAndGrazingStayFiniteAndKeepTheirEnergy) {
    for (const double h : {-1.0, 1.0, std::nextafter(1.0, 0.0), 0.0}) {
        for (const double sin_o : {0.0, 0.9999999999, 1.0}) {
            const Inclination o{sin_o, std::sqrt(1.0 - sin_o * sin_o)};
            const ChiangScattering s(chiang_fibre(glm::dvec3(0.0), 0.3, 0.3), h, o);
            EXPECT_NEAR(s.albedo().x, 1.0, 1e-12) << "h " << h << ", sin θ " << sin_o;
            for (int i = 0; i < 500; ++i) {
                test::Random random(3, i);
                const auto sample =
                    s.sample({random.unit(), random.unit(), random.unit(), random.unit()});
                ASSERT_TRUE(std::isfinite(sample.pdf) && sample.pdf > 0.0);
                ASSERT_NEAR(sample.weight.x, 1.0, 1e-9);
            }
        }
    }
    // At |h| = 1 all is reflected: no light enters.
    const ChiangScattering edge(chiang_fibre(glm::dvec3(1.0), 0.3, 0.3), 1.0, inclined(20.0));
    EXPECT_DOUBLE_EQ(edge.attenuation()[0].x, 1.0);
    EXPECT_DOUBLE_EQ(edge.attenuation()[1].x, 0.0);
}

TEST(Chiang, BlackFibresOnlyReflectAtTheSurface) {
    const ChiangScattering s(chiang_from_karis(glm::dvec3(0.0), 0.3, 0.0), 0.2, inclined(10.0));
    EXPECT_LT(s.attenuation()[1].x, 1e-12);
    EXPECT_GT(s.attenuation()[0].x, 0.03);
    const auto sample = s.sample({0.999999, 0.5, 0.5, 0.5});
    EXPECT_TRUE(std::isfinite(sample.weight.x));
}

TEST(Chiang, KarisParametersGiveHisWidthsAndAbsorption) {
    const ChiangFibre fibre = chiang_from_karis(glm::dvec3(0.5, 0.2, 1.0), 0.4, 0.035);
    EXPECT_DOUBLE_EQ(fibre.variance[0], std::pow(0.4, 4.0));
    EXPECT_DOUBLE_EQ(fibre.variance[1], std::pow(0.5 * 0.4 * 0.4, 2.0));
    EXPECT_DOUBLE_EQ(fibre.variance[2], std::pow(2.0 * 0.4 * 0.4, 2.0));
    // Straight through the middle: C^½ (karis.glsl) times what both surfaces let pass.
    const ChiangScattering s(fibre, 0.0, inclined(0.0));
    const double f = fresnel_dielectric(1.0, fibre.eta);
    EXPECT_NEAR(s.attenuation()[1].x, std::sqrt(0.5) * (1 - f) * (1 - f), 1e-12);
    EXPECT_NEAR(s.attenuation()[1].z, (1 - f) * (1 - f), 1e-12);
}

TEST(Chiang, KarisParametersGiveHisAzimuthalWidths) {
    // A logistic's deviation is π s / √3; Karis's are rounded to five digits.
    EXPECT_NEAR(kPi * kKarisScaleTt / std::sqrt(3.0), kKarisAzimuthalTt, 1e-4);
    EXPECT_NEAR(kPi * kKarisScaleTrt / std::sqrt(3.0), kKarisAzimuthalTrt, 1e-4);
    const ChiangFibre fibre = chiang_from_karis(glm::dvec3(0.5), 0.4, 0.0);
    EXPECT_DOUBLE_EQ(fibre.azimuthal_scale[1], kKarisScaleTt);
    EXPECT_DOUBLE_EQ(fibre.azimuthal_scale[2], kKarisScaleTrt);
    // TT and TRT sampled from a ray through the middle: mean square of the azimuth about π and 0.
    const ChiangScattering s(fibre, 0.0, inclined(0.0));
    constexpr int kSamples = 20'000;
    double squares = 0.0;
    const double r = s.attenuation()[0].x + s.attenuation()[0].y + s.attenuation()[0].z;
    double all = 0.0;
    for (const auto& lobe : s.attenuation()) all += lobe.x + lobe.y + lobe.z;
    const double tt = s.attenuation()[1].x + s.attenuation()[1].y + s.attenuation()[1].z;
    for (int i = 0; i < kSamples; ++i) {
        const double u = (i + 0.5) / kSamples;
        const auto sample = s.sample({(r + 0.5 * tt) / all, 0.5, 0.5, u});
        squares += std::pow(std::remainder(sample.phi - kPi, 2.0 * kPi), 2.0) / kSamples;
    }
    // The tails cut off at ±π hold some 0.3 % of the square.
    EXPECT_NEAR(std::sqrt(squares), kKarisAzimuthalTt, 0.01);
}

TEST(Chiang, LogisticIntegratesToOne) {
    for (const double s : {0.005, 0.1, 0.6, 4.0}) {
        constexpr int kSteps = 200'000;
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            sum += trimmed_logistic(kPi * (2.0 * (i + 0.5) / kSteps - 1.0), s);
        }
        EXPECT_NEAR(sum * 2.0 * kPi / kSteps, 1.0, 1e-8) << "s " << s;
    }
}

TEST(Chiang, LongitudinalIsNormalisedToTenDigits) {
    for (const double v : {1e-6, 1e-5, 1e-3, 0.02, 0.3, 2.0}) {
        for (const double degrees : {0.0, 35.0, 85.0, 89.9}) {
            // Simpson's rule in θ over twelve deviations around the mirrored inclination: error
            // below (step / √v)⁴ / 180, some 1e-15, where the lobe ends at ±90° as well.
            const double theta_r = degrees * kDegree;
            const double reach = 12.0 * std::sqrt(v) + 1e-9;
            const double low = std::max(-theta_r - reach, -0.5 * kPi);
            const double high = std::min(-theta_r + reach, 0.5 * kPi);
            constexpr int kSteps = 40'000;
            double sum = 0.0;
            for (int i = 0; i <= kSteps; ++i) {
                const double theta = low + (high - low) * i / kSteps;
                const double weight = i == 0 || i == kSteps ? 1.0 : (i % 2 == 0 ? 2.0 : 4.0);
                sum += weight * std::cos(theta) *
                       longitudinal_deon(v, {std::sin(theta), std::cos(theta)},
                                         {std::sin(theta_r), std::cos(theta_r)});
            }
            EXPECT_NEAR(sum * (high - low) / (3.0 * kSteps), 1.0, 1e-10)
                << "v " << v << ", θ " << degrees;
        }
    }
}

TEST(Dielectric, FresnelIsKnownAtItsEnds) {
    EXPECT_NEAR(fresnel_dielectric(1.0, 1.55), std::pow(0.55 / 2.55, 2.0), 1e-15);
    EXPECT_DOUBLE_EQ(fresnel_dielectric(0.0, 1.55), 1.0);
    // At Brewster's angle only one polarisation is left: half of ((n² - 1) / (n² + 1))².
    const double n2 = 1.55 * 1.55;
    EXPECT_NEAR(fresnel_dielectric(1.0 / std::sqrt(1.0 + n2), 1.55),
                0.5 * std::pow((n2 - 1.0) / (n2 + 1.0), 2.0), 1e-12);
}

}  // namespace
}  // namespace vellus::hair::reference
