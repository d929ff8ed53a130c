#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/hair/reference/longitudinal.h"
#include "tests/stability/cases.h"
#include "tests/stability/report.h"

// Rows "roughness" and "colour" of the hard cases.
namespace vellus::test {
namespace {

using namespace hair::probe;  // NOLINT(google-build-using-namespace)

constexpr float kRoughness[] = {0.0f, 1e-20f, 1e-3f, 0.01f, 0.045f, 0.2f, 0.5f, 1.0f, 1.5f};

HairSurface surface(const glm::vec3& color, float roughness) {
    return {.base_color = color,
            .specular = 0.5f,
            .roughness = roughness,
            .scatter = 1.0f,
            .shift = 0.0f};
}

/// ∫ lobe d(sin θi + sin θr) by the midpoint rule over ±8 β.
template <class F>
double lobe_energy(double beta, const F& lobe) {
    constexpr int kSteps = 4000;
    const double width = 16.0 * beta;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
        sum += lobe(static_cast<float>(width * ((i + 0.5) / kSteps - 0.5)));
    return sum * width / kSteps;
}

TEST(Roughness, LobeEnergyDoesNotDependOnIt) {
    // TT and TRT at fixed angles: the longitudinal lobe integrates to 1, so what is left is N (1 -
    // f)² f^(p-1).
    Worst worst;
    const vec3 clear = hair_log2_color(vec3(1.0f));
    for (const float r : kRoughness) {
        const HairSurface s = surface(vec3(1.0f), r);
        const double tt = lobe_energy(std::max(0.5 * r * r, 1e-3), [&](float x) {
            return karis_tt(s, clear, x, 1.0f, -1.0f, 0.0f).x;
        });
        const double trt = lobe_energy(std::max(2.0 * r * r, 1e-3), [&](float x) {
            return karis_trt(s, clear, x, 1.0f, 1.0f, 0.0f).x;
        });
        const double f0 = 0.55 * 0.55 / (2.55 * 2.55);
        const double f = f0 + (1.0 - f0) / 32.0;
        const double exact_tt = std::exp(3.65 - 3.98) * (1.0 - f0) * (1.0 - f0);
        const double exact_trt = std::exp(17.0 - 16.78) * (1.0 - f) * (1.0 - f) * f;
        worst.add(std::abs(tt / exact_tt - 1.0), [&] { return fmt::format("TT, r = {}", r); });
        worst.add(std::abs(trt / exact_trt - 1.0), [&] { return fmt::format("TRT, r = {}", r); });
    }
    worst.report("roughness", "lobe energy 1 ± 1 %", 0.01);
}

TEST(Roughness, ExactLobeHoldsDownToTheLeastVariance) {
    Worst worst;
    for (int i = 0; i < 36; ++i) {
        const double v = 1e-6 * std::pow(1.5, i);
        for (int j = -31; j <= 31; ++j) {
            const double theta = 0.05 * j;
            const double reach = 12.0 * std::sqrt(v);
            const double low = std::max(-theta - reach, -0.5 * std::numbers::pi);
            const double high = std::min(-theta + reach, 0.5 * std::numbers::pi);
            double energy = 0.0;
            constexpr int kSteps = 2000;
            for (int k = 0; k < kSteps; ++k) {
                const double at = low + (high - low) * (k + 0.5) / kSteps;
                energy += hair::reference::longitudinal_deon(v, at, theta) * std::cos(at);
            }
            energy *= (high - low) / kSteps;
            worst.add(std::abs(energy - 1.0),
                      [&] { return fmt::format("v = {:.3g}, θr = {:.3g}", v, theta); });
        }
    }
    worst.report("roughness", "d'Eon's M (double) integrates to 1", 1e-5);
}

TEST(Roughness, AnyValueIsFinite) {
    expect_finite("roughness", "β = 0 ... > 1", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        p.roughness = kRoughness[random.bits() % std::size(kRoughness)];
        if ((random.bits() & 1) != 0)
            p.to_light = inclined(random, p.tangent, -glm::dot(p.tangent, p.to_view));
        return p;
    });
}

TEST(Roughness, PeaksFitAHalfFloat) {
    Worst worst;
    for (uint64_t i = 0; i < 400'000; ++i) {
        Random random(5, i);
        const ProbeInput p = extreme_input(random);
        const HairFrame f = hair_frame(p.tangent, p.to_view);
        worst.add(karis_bsdf(probe_surface(p), f, p.to_light).x, [&] { return describe(p); });
    }
    worst.report("roughness", "largest S; half holds 65504", 65504.0);
}

TEST(Colour, BlackReflectsOnly) {
    Worst worst;
    for (uint64_t i = 0; i < 200'000; ++i) {
        Random random(6, i);
        ProbeInput p = ordinary_input(random);
        p.color = vec3(0.0f);
        HairSurface s = probe_surface(p);
        s.specular = 0.0f;
        const vec3 all =
            karis_bsdf(s, hair_frame(p.tangent, p.to_view), p.to_light) +
            karis_scattering(s, hair_frame(p.tangent, p.to_view), p.to_light, p.shadow);
        worst.add(all.x + all.y + all.z, [&] { return describe(p); });
    }
    // The least colour log2 sees is 1e-37; the shortest TT takes it to the power 0.38.
    worst.report("colour", "C = 0: TT, TRT, scattering", 1e-10);
}

TEST(Colour, WhiteAbsorbsNothingAndHasNoTint) {
    Worst worst;
    for (uint64_t i = 0; i < 100'000; ++i) {
        Random random(7, i);
        ProbeInput p = ordinary_input(random);
        p.color = vec3(1.0f);
        const HairFrame f = hair_frame(p.tangent, p.to_view);
        const float lit = karis_scattering(probe_surface(p), f, p.to_light, 1.0f).x;
        const float dark = karis_scattering(probe_surface(p), f, p.to_light, 0.0f).x;
        worst.add(std::abs(lit - dark), [&] { return describe(p); });
        worst.add(std::abs(lit - p.scatter * (glm::dot(f.normal, p.to_light) + 1.0) /
                                     (4.0 * std::numbers::pi)),
                  [&] { return describe(p); });
    }
    // Luma's weights sum to 1 within a rounding error.
    worst.report("colour", "C = 1: scattering without tint", 1e-6);
}

TEST(Colour, ZeroAndOneInSingleChannels) {
    expect_finite("colour", "channels of 0, 1, tiny", [](Random& random) {
        ProbeInput p = ordinary_input(random);
        const float values[] = {0.0f, 1.0f, 1e-45f, 1e-38f, 1e-7f, 0.99999994f};
        for (int c = 0; c < 3; ++c) p.color[c] = values[random.bits() % 6];
        p.shadow = random.bits() % 3 == 0 ? 0.0f : static_cast<float>(random.unit());
        return p;
    });
    expect_continuous(
        "colour", "channels of 0, 1, tiny",
        [](Random& random) {
            ProbeInput p = ordinary_input(random);
            const float values[] = {0.0f, 1.0f, 1e-45f, 1e-38f, 1e-7f, 0.99999994f};
            for (int c = 0; c < 3; ++c) p.color[c] = values[random.bits() % 6];
            return p;
        },
        0.01);
}

TEST(Colour, TintOfNearlyBlackIsBounded) {
    // (C / Luma)^(1 - shadow) at Luma -> 0 stays the tint of the colour, at most 1 / 0.11 for pure
    // blue.
    Worst worst;
    for (const float scale : {1.0f, 1e-6f, 1e-20f, 1e-36f}) {
        HairSurface s = surface(vec3(0.0f, 0.0f, scale), 0.3f);
        const HairFrame f = hair_frame({1, 0, 0}, {0, 0, 1});
        const float dark = karis_scattering(s, f, {0, 0, 1}, 0.0f).z;
        const float lit = karis_scattering(s, f, {0, 0, 1}, 1.0f).z;
        worst.add(std::abs(dark / lit * 0.11 - 1.0), [&] { return fmt::format("blue {}", scale); });
    }
    // exp2 and log2 of exponents up to 120: 120 ulp; at 1e-36 the clamp at 1e-37 of red and green
    // shows (0.8).
    worst.report("colour", "tint of dark blue", 0.5);
    const HairSurface black = surface(vec3(0.0f), 0.3f);
    const HairFrame f = hair_frame({1, 0, 0}, {0, 0, 1});
    const float ratio = karis_scattering(black, f, {0, 0, 1}, 0.0f).x /
                        karis_scattering(black, f, {0, 0, 1}, 1.0f).x;
    report_row({"colour", "tint of black is 1", "C = 0", std::abs(ratio - 1.0), 1e-4});
}

}  // namespace
}  // namespace vellus::test
