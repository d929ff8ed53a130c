#include "modules/hair/scattering/fibre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/hair/reference/deon.h"
#include "modules/hair/reference/dielectric.h"
#include "modules/hair/reference/kajiya_kay.h"
#include "modules/hair/reference/longitudinal.h"
#include "modules/hair/reference/marschner.h"
#include "modules/hair/scattering/fibre_library.h"
#include "tests/support/sampling.h"
#include "tests/support/scattering_error.h"

namespace vellus::hair {
namespace {

using glsl::HairFibre;
using glsl::HairSurface;

constexpr double kPi = std::numbers::pi;

HairSurface surface(const glm::vec3& color, float roughness, float shift = 0.035f) {
    return {color, 0.5f, roughness, 1.0f, shift};
}

HairFibre fibre_of(const HairSurface& s, const FibreOptics& optics = {}) {
    HairFibre fibre{};
    fit_azimuthal(optics, fibre);
    set_longitudinal(s.roughness, s.shift, fibre);
    return fibre;
}

/// Angles of a random pair of directions, some of them grazing but outside the azimuth's fade.
struct Path {
    double theta_i, theta_r, phi;
    glm::vec3 to_light;
    glsl::HairFrame frame;
};

Path random_path(uint64_t index) {
    test::Random random(41, index);
    const auto incline = [&] {
        return index % 4 == 0 ? (0.5 * kPi - random.log_range(0.05, 0.3)) *
                                    ((random.bits() & 1) != 0 ? 1.0 : -1.0)
                              : std::asin(random.range(-1.0, 1.0));
    };
    Path path{.theta_i = incline(), .theta_r = incline(), .phi = random.range(0.0, 3.05)};
    path.to_light = glm::dvec3(std::sin(path.theta_i), std::cos(path.theta_i) * std::sin(path.phi),
                               std::cos(path.theta_i) * std::cos(path.phi));
    path.frame =
        glsl::hair_frame({1, 0, 0}, glm::vec3(std::sin(path.theta_r), 0.0, std::cos(path.theta_r)));
    return path;
}

TEST(FibreLobes, RationalBesselsKeepTheirPromise) {
    double a2 = 0.0;
    double b = 0.0;
    double exact = 0.0;
    for (int i = 0; i < 200'000; ++i) {
        const double x = i == 0 ? 0.0 : 1e-4 * std::pow(1e11, i / 200'000.0);
        const auto xf = static_cast<float>(x);
        const double truth = reference::bessel_i0e(xf);
        a2 = std::max(a2, std::abs(glsl::bessel_i0e_a2(glm::vec3(xf)).x / truth - 1.0));
        b = std::max(b, std::abs(glsl::bessel_i0e_b(glm::vec3(xf)).x / truth - 1.0));
        exact = std::max(exact, std::abs(glsl::bessel_i0e_exact(glm::vec3(xf)).x / truth - 1.0));
    }
    EXPECT_LT(a2, 0.024);
    EXPECT_LT(b, 0.0025);
    EXPECT_LT(exact, 1e-6);
}

TEST(FibreLobes, TiersOfMAreDeonsOverRandomInputs) {
    double worst[4] = {};
    for (uint64_t i = 0; i < 300'000; ++i) {
        const Path path = random_path(i);
        test::Random random(42, i);
        const auto roughness = static_cast<float>(random.range(0.05, 1.0));
        const auto shift = static_cast<float>(random.range(-0.2, 0.2));
        HairFibre fibre{};
        set_longitudinal(roughness, shift, fibre);
        const auto eye = glsl::hair_eye(fibre, path.frame);
        const auto s = static_cast<float>(std::sin(path.theta_i));
        const auto c = static_cast<float>(std::cos(path.theta_i));
        const auto exact = reference::karis_fibre(surface(glm::vec3(1.0f), roughness, shift), 0);
        for (int tier = 1; tier < 4; ++tier) {
            const glm::vec3 m = glsl::longitudinal(tier, fibre, eye, s, c);
            for (int p = 0; p < 3; ++p) {
                const double truth =
                    reference::deon_longitudinal(exact, p, path.theta_i, path.theta_r);
                const double floor = 1e-3 * fibre.peak[p];
                worst[tier] = std::max(worst[tier], std::abs(m[p] - truth) / (truth + floor));
            }
        }
    }
    // Rounding of the directions, 1e-7, over the narrowest lobe, β = 1.25e-3: 1e-4 of a slope.
    EXPECT_LT(worst[glsl::kLongitudinalA2], 0.024 + 1e-3);
    EXPECT_LT(worst[glsl::kLongitudinalB], 0.0025 + 1e-3);
    EXPECT_LT(worst[glsl::kLongitudinalExact], 1e-3);
}

TEST(FibreLobes, FresnelIsExact) {
    for (const float eta : {1.1f, 1.55f, 3.0f}) {
        for (int i = 0; i <= 1000; ++i) {
            const float c = static_cast<float>(i) / 1000.0f;
            EXPECT_NEAR(glsl::fresnel_exact(eta * eta - 1.0f, c),
                        reference::fresnel_dielectric(c, eta), 2e-6);
        }
    }
}

TEST(FibreLobes, DeonOnTheDeviceIsTheReference) {
    for (const float roughness : {0.2f, 0.5f, 1.0f}) {
        const HairSurface s = surface({0.9f, 0.3f, 0.02f}, roughness);
        const HairFibre fibre = fibre_of(s);
        for (uint64_t i = 0; i < 1500; ++i) {
            const Path path = random_path(i);
            const glm::vec3 value = glsl::deon_bsdf(
                fibre, s, path.frame, glsl::hair_eye(fibre, path.frame), path.to_light);
            for (int c = 0; c < 3; ++c) {
                const double exact = reference::deon(reference::karis_fibre(s, c), path.theta_i,
                                                     path.theta_r, path.phi);
                // Inclinations round to 1e-7 of a lobe as narrow as 0.02; the midpoint rule's 1e-4.
                EXPECT_NEAR(value[c], exact, 2e-3 * (exact + 0.01)) << i << " " << c;
            }
        }
    }
}

TEST(FibreLobes, MarschnerOnTheDeviceIsTheReference) {
    // TRT's roots come from the paper's cubic instead of the exact azimuth: R + TT are compared
    // point by point, all lobes on average.
    const HairSurface s = surface({0.9f, 0.3f, 0.02f}, 0.5f);
    const HairFibre fibre = fibre_of(s);
    double off = 0.0;
    double total = 0.0;
    for (uint64_t i = 0; i < 6'000; ++i) {
        const Path path = random_path(i);
        if (std::abs(std::cos(0.5 * (path.theta_r - path.theta_i))) < 0.05) continue;
        const glm::vec3 value = glsl::marschner_bsdf(fibre, s, path.frame, path.to_light);
        for (int c = 0; c < 3; ++c) {
            const auto exact_fibre = reference::karis_fibre(s, c);
            const double exact =
                reference::marschner(exact_fibre, path.theta_i, path.theta_r, path.phi);
            off += std::abs(value[c] - exact) * std::cos(path.theta_i);
            total += exact * std::cos(path.theta_i);
        }
    }
    RecordProperty("l1", std::to_string(off / total));
    EXPECT_LT(off / total, 0.02);
    for (const double phi : {0.3, 1.0, 2.0, 2.6, 3.0}) {
        const double theta_d = 0.4;
        const double inverse = 1.0 / reference::modified_index(1.55, theta_d);
        const auto exact_fibre = reference::karis_fibre(s, 1);
        const double cos2_t = 1.0 - std::pow(std::sin(theta_d) / 1.55, 2.0);
        const auto half_log = static_cast<float>(std::log2(0.3) * 0.5 / std::sqrt(cos2_t));
        const auto tt = glsl::marschner_tt(
            fibre, glm::vec3(half_log), static_cast<float>(std::cos(theta_d)),
            static_cast<float>(inverse), static_cast<float>(std::cos(0.5 * phi)));
        EXPECT_NEAR(tt.x, reference::marschner_azimuthal(exact_fibre, 1, theta_d, phi), 2e-5);
    }
}

TEST(FibreLobes, KajiyaKayOnTheDeviceIsTheReference) {
    for (const float roughness : {0.0f, 0.1f, 0.4f, 1.0f}) {
        const HairSurface s = surface({0.9f, 0.3f, 0.02f}, roughness);
        for (uint64_t i = 0; i < 100'000; ++i) {
            const Path path = random_path(i);
            const glm::vec3 value = glsl::kajiya_kay_bsdf(s, path.frame, path.to_light);
            for (int c = 0; c < 3; ++c) {
                const auto k = reference::kajiya_kay_parameters(s, c);
                const double exact = reference::kajiya_kay(k, path.theta_i, path.theta_r);
                // An angle of 1e-7 over the width of the highlight, at its height.
                const double slope = k.specular * 3e-7 * std::sqrt(k.exponent) * 4.0;
                EXPECT_NEAR(value[c], exact, 1e-4 * exact + 1e-6 + slope) << i;
            }
        }
    }
}

TEST(FibreLobes, SeriesMeetsItsTargetAndKarisIsWhereItIsKnownToBe) {
    // Issue: 3 % of d'Eon's, energy-weighted L1, and a white furnace within 0.95-1.05 of d'Eon's
    // own.
    double karis = 0.0;
    double series = 0.0;
    int grids = 0;
    for (const float roughness : {0.3f, 0.5f, 1.0f}) {
        for (const float color : {0.02f, 0.3f, 1.0f}) {
            const test::DeonGrid grid(surface(glm::vec3(color), roughness), {}, 60, 20);
            karis += grid.error(glsl::kScatteringKaris).l1;
            const auto b = grid.error(glsl::kScatteringSeriesB);
            series += b.l1;
            EXPECT_LT(b.l1, 0.02);
            EXPECT_GT(b.furnace_least, 0.95);
            EXPECT_LT(b.furnace_most, 1.05);
            EXPECT_LT(grid.error(glsl::kScatteringSeriesA2).l1, 0.03);
            EXPECT_LE(grid.error(glsl::kScatteringSeriesExact).l1, b.l1 + 2e-3);
            ++grids;
        }
    }
    EXPECT_NEAR(karis / grids, 0.48, 0.06);
    EXPECT_LT(series / grids, 0.012);
}

TEST(FibreLobes, SeriesFollowsIndexAndAzimuthalWidth) {
    // Karis's fits know neither. Narrow detectors need terms the series has not.
    for (const FibreOptics& optics :
         {FibreOptics{.eta = 1.33f}, FibreOptics{.eta = 2.0f}, FibreOptics{1.55f, 0.95f, 0.41f}}) {
        const test::DeonGrid grid(surface(glm::vec3(0.5f), 0.5f), optics, 50, 20);
        EXPECT_LT(grid.error(glsl::kScatteringSeriesB).l1, 0.03) << optics.eta;
        EXPECT_GT(grid.error(glsl::kScatteringKaris).l1, 0.3) << optics.eta;
    }
}

TEST(FibreLobes, LibraryFitsEachMaterialOnce) {
    FibreLibrary library;
    HairMaterial material;
    const auto first = library.fibre(fibre_optics(material), 0.3f, 0.0f);
    static_cast<void>(library.fibre(fibre_optics(material), 0.5f, 0.03f));
    EXPECT_EQ(library.fitted(), 1u);
    material.eta = 1.4f;
    const auto other = library.fibre(fibre_optics(material), 0.3f, 0.0f);
    EXPECT_EQ(library.fitted(), 2u);
    EXPECT_NE(first.tt[0], other.tt[0]);
    for (int i = 0; i < 200; ++i) {
        static_cast<void>(
            library.fibre({.eta = 1.2f + 0.005f * static_cast<float>(i)}, 0.3f, 0.0f));
    }
    const size_t fits = library.fitted();
    static_cast<void>(library.fibre({.eta = 1.2f + 0.005f * 199.0f}, 0.3f, 0.0f));
    EXPECT_EQ(library.fitted(), fits);
}

}  // namespace
}  // namespace vellus::hair
