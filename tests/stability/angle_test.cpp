#include <gtest/gtest.h>

#include <cmath>

#include "tests/stability/cases.h"
#include "tests/stability/report.h"

// Rows "angles" and "tangent" of the hard cases: degenerate directions of light, eye and fibre.
namespace vellus::test {
namespace {

using namespace hair::probe;  // NOLINT(google-build-using-namespace)

// One ulp (6e-8) of a direction moves cos φ by 6e-8 / 3e-4 = 2e-4 where the azimuth fades out, and
// the exponents by up to 17 times that; (sin θi + sin θr) / β moves by 6e-8 / 1e-3 in the narrowest
// lobe.
constexpr double kContinuity = 0.01;

void check(const std::string& area, const std::string& test, const Generator& generator) {
    expect_finite(area, test, generator);
    expect_continuous(area, test, generator, kContinuity);
}

TEST(Angles, SineOfOneWithinAnUlp) {
    check("angles", "sin θ = ±1 ± 2^-23", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        const float length = 1.0f + (static_cast<float>(random.bits() % 3) - 1.0f) / 8388608.0f;
        p.to_light = p.tangent * ((random.bits() & 1) != 0 ? length : -length);
        if ((random.bits() & 1) != 0)
            p.to_view = p.tangent * ((random.bits() & 1) != 0 ? length : -length);
        return p;
    });
}

TEST(Angles, MirroredInclination) {
    check("angles", "θr = -θi", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        const double sine = random.range(-1.0, 1.0);
        p.to_light = inclined(random, p.tangent, sine);
        p.to_view = inclined(random, p.tangent, -sine);
        return p;
    });
}

TEST(Angles, SumOfHalfATurn) {
    check("angles", "θi + θr = ±180°", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        const double sine = (random.bits() & 1) != 0 ? 1.0 : -1.0;
        p.to_light = inclined(random, p.tangent, sine * (1.0 - random.log_range(1e-16, 1e-3)));
        p.to_view = inclined(random, p.tangent, sine * (1.0 - random.log_range(1e-16, 1e-3)));
        return p;
    });
}

TEST(Angles, AzimuthOfZeroAndHalfATurn) {
    check("angles", "φ = 0, ±π", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        p.to_light = inclined(random, p.tangent, random.range(-0.99, 0.99));
        const glm::dvec3 u = glm::normalize(glm::dvec3(p.tangent));
        const glm::dvec3 across =
            glm::normalize(glm::dvec3(p.to_light) - u * glm::dot(u, glm::dvec3(p.to_light)));
        const double sine = random.range(-0.99, 0.99);
        p.to_view = u * sine + across * (((random.bits() & 1) != 0 ? 1.0 : -1.0) *
                                         std::sqrt(1.0 - sine * sine));
        return p;
    });
}

TEST(Angles, EdgeOfTransmission) {
    // φ = 2 asin a, a = 1/η', where h reaches 1: beyond it 1 - h² is clamped.
    check("angles", "φ = 2 asin a", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        p.tangent = {1, 0, 0};
        const double theta = random.range(-1.5, 1.5);
        const double a = std::cos(theta) / (1.19 + 0.36 * std::cos(theta) * std::cos(theta));
        const double phi = 2.0 * std::asin(a) + random.range(-1e-6, 1e-6);
        p.to_light = glm::dvec3(std::sin(theta), 0.0, std::cos(theta));
        p.to_view = glm::dvec3(-std::sin(theta), std::cos(theta) * std::sin(phi),
                               std::cos(theta) * std::cos(phi));
        return p;
    });
}

TEST(Angles, AbsorptionWhereTheDifferenceAngleIsARightOne) {
    // θi = 90°, θr = -90°: the path inside is endless: nothing passes a fibre that absorbs, all one
    // that does not.
    Worst grey;
    Worst white;
    for (const float color : {1e-3f, 0.5f, 0.9f, 0.999f}) {
        HairSurface s{glm::vec3(color), 0.5f, 0.3f, 1.0f, 0.0f};
        const float trt = karis_trt(s, hair_log2_color(s.base_color), 0.0f, 0.0f, 1.0f, 0.0f).x;
        const float tt = karis_tt(s, hair_log2_color(s.base_color), 0.0f, 0.0f, -1.0f, 0.0f).x;
        grey.add(std::max(trt, tt), [&] { return "C = " + std::to_string(color); });
    }
    const vec3 clear = hair_log2_color(vec3(1.0f)) * (0.8f / kHairMinCosD);
    white.add(std::abs(std::exp2(clear.x) - 1.0f), [] { return std::string("C = 1"); });
    grey.report("angles", "cos θd = 0, C < 1: absorbed", 1e-3);
    white.report("angles", "cos θd = 0, C = 1: not absorbed", 0.0);
    check("angles", "cos θd -> 0", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        p.to_light = inclined(random, p.tangent, 1.0 - random.log_range(1e-16, 1e-2));
        p.to_view = inclined(random, p.tangent, random.log_range(1e-16, 1e-2) - 1.0);
        return p;
    });
}

TEST(Angles, ReflectionOfZeroWidthIsZero) {
    Worst worst;
    for (uint64_t i = 0; i < 10000; ++i) {
        Random random(3, i);
        ProbeInput p = ordinary_input(random);
        const HairFrame f = hair_frame(p.tangent, p.to_view);
        const float r = karis_r(probe_surface(p), f, -f.sin_r, f.cos_r, 0.0f, 0.0f);
        worst.add(r, [&] { return describe(p); });
    }
    worst.report("angles", "azimuthal R of width 0", 0.0);
}

TEST(Tangent, AlongTheLightOrTheEye) {
    check("tangent", "T ∥ L, T ∥ V, L = ±V", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        const double sign = (random.bits() & 1) != 0 ? 1.0 : -1.0;
        const double off = (random.bits() & 1) != 0 ? 0.0 : random.log_range(1e-16, 1e-4);
        glm::vec3& moved = (random.bits() & 1) != 0 ? p.to_light : p.to_view;
        moved = inclined(random, p.tangent, sign * (1.0 - off));
        if (random.bits() % 4 == 0) p.to_light = (random.bits() & 1) != 0 ? p.to_view : -p.to_view;
        return p;
    });
}

TEST(Tangent, FakeNormalIsBoundedAndPerpendicular) {
    Worst length;
    Worst angle;
    for (uint64_t i = 0; i < 200'000; ++i) {
        Random random(4, i);
        const ProbeInput p = extreme_input(random);
        if (p.tangent == glm::vec3(0.0f)) continue;
        const HairFrame f = hair_frame(p.tangent, p.to_view);
        length.add(glm::length(f.normal) - 1.0, [&] { return describe(p); });
        angle.add(std::abs(glm::dot(glm::dvec3(f.normal), glm::dvec3(p.tangent))),
                  [&] { return describe(p); });
    }
    length.report("tangent", "fake normal: length - 1", 2e-7);
    // The part along u is a rounding error of 1e-7, divided by at least 3e-4.
    angle.report("tangent", "fake normal: n·u", 1e-3);
}

TEST(Tangent, ZeroLengthIsShadedLikeAPoint) {
    check("tangent", "zero tangent", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        p.tangent = glm::vec3(0.0f);
        return p;
    });
}

TEST(Tangent, AFoldIsFinite) {
    // A 180° fold averages two opposite tangents to anything down to zero; shaders normalise or get
    // zero.
    check("tangent", "180° fold", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        p.tangent =
            (random.bits() & 1) != 0 ? -p.tangent : p.tangent * static_cast<float>(random.unit());
        return p;
    });
}

TEST(Everything, OrdinaryInputs) {
    expect_continuous("all", "ordinary", ordinary_input, kContinuity, 2'000'000);
}

}  // namespace
}  // namespace vellus::test
