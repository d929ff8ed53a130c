#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/stability/cases.h"
#include "tests/stability/report.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

// Rows "exponential shadow", "TAA", "light" and "denormals" of the hard cases.
namespace vellus::test {
namespace {

using namespace hair::probe;  // NOLINT(google-build-using-namespace)

TEST(Shadow, ReceiverBeforeCasterIsLitFarBehindIsDark) {
    report_row({"shadow", "receiver before caster: 1", "-",
                std::abs(1.0 - exponential_transmittance(1.0f, 1.0f + 1e-6f, 1e30f)), 0.0});
    report_row({"shadow", "c Δz = 1e4: 0", "-", exponential_transmittance(11.0f, 1.0f, 1e3f), 0.0});
    report_row({"shadow", "empty texel: 1", "depth 1e30",
                std::abs(1.0 - exponential_transmittance(10.0f, 1e30f, 1e3f)), 0.0});
}

TEST(Shadow, AnyDepthsAndAOneTexelMapAreFinite) {
    Worst worst;
    const float lengths[] = {0.0f, 1e-38f, 1e-3f, 1.0f, 1e4f, 1e30f};
    for (uint64_t i = 0; i < 100'000; ++i) {
        Random random(1, i);
        const auto any = [&] { return lengths[random.bits() % 6]; };
        const vec4 depths(any(), any(), any(), any());
        const vec2 uv(random.unit(), random.unit());
        const vec4 weights =
            pcf_gather_weights(pcf_fraction(uv, vec2(random.bits() % 2 == 0 ? 1.0f : 1024.0f)));
        const float light = glm::dot(weights, exponential_transmittance(any(), depths, any()));
        const bool fine = std::isfinite(light) && light >= 0.0f;
        worst.add(fine ? std::max(light - 1.0, 0.0) : 1.0,
                  [&] { return fmt::format("light {}", light); });
    }
    // Four weights sum to 1 within a rounding error.
    worst.report("shadow", "any depths, 1-texel map: in [0, 1]", 3e-7);
}

constexpr int kSide = 8;
using Picture = std::array<std::array<vec3, kSide>, kSide>;

/// One frame of TAA over a small still picture, as the pass does it: 3×3 box, clamp, resolve.
void resolve(const Picture& current, Picture& history, float blend) {
    Picture next = history;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const vec3 centre = taa_load(current[y][x]);
            TaaBox box = taa_box_start(centre);
            for (int k = 0; k < 9; ++k) {
                const int row = std::clamp(y + k / 3 - 1, 0, kSide - 1);
                const int column = std::clamp(x + k % 3 - 1, 0, kSide - 1);
                taa_box_add(box, taa_load(current[row][column]));
            }
            const vec3 old = taa_clamp(box, rgb_to_ycocg(taa_sanitize(history[y][x])));
            next[y][x] = taa_resolve(centre, old, blend);
        }
    }
    history = next;
}

TEST(Taa, GarbageInOneFrameIsGoneWithinEight) {
    const float infinity = std::numeric_limits<float>::infinity();
    Worst worst;
    for (const float bad : {std::nanf(""), infinity, -infinity, 1e6f, -1e6f, 3e38f}) {
        Picture clean{};
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) clean[y][x] = vec3(0.1f * x, 0.5f, 0.05f * y);
        }
        Picture expected = clean;
        Picture history = clean;
        Picture broken = clean;
        broken[4][4] = vec3(bad, 0.5f, 0.5f);
        resolve(broken, history, 0.1f);
        resolve(clean, expected, 0.1f);
        for (int frame = 0; frame < 8; ++frame) {
            resolve(clean, history, 0.1f);
            resolve(clean, expected, 0.1f);
        }
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const double error = glm::length(history[y][x] - expected[y][x]);
                worst.add(error, [&] { return fmt::format("{} in one pixel", bad); });
            }
        }
    }
    worst.report("taa", "NaN, Inf, ±1e6: left after 8 frames", 1.0 / 255.0 / 2.0);
}

TEST(Taa, FirstFrameAndDisocclusionTakeTheCurrentColour) {
    Worst worst;
    for (uint64_t i = 0; i < 100'000; ++i) {
        Random random(2, i);
        const vec3 color(random.log_range(1e-4, 1e3), random.unit(), random.unit());
        const vec3 garbage(random.log_range(1e-4, 1e3), random.unit(), 0.0);
        const float blend = taa_blend({1.5f, 0.5f}, 0.1f);
        const vec3 value = taa_resolve(rgb_to_ycocg(color), rgb_to_ycocg(garbage), blend);
        worst.add(glm::length(value - color) / glm::length(color),
                  [&] { return fmt::format("{}", color.x); });
    }
    // YCoCg and back: three roundings of the largest channel.
    worst.report("taa", "no history: the current colour", 3e-7);
}

TEST(Taa, StillPictureStaysStill) {
    Worst worst;
    for (uint64_t i = 0; i < 100'000; ++i) {
        Random random(3, i);
        const vec3 color(random.log_range(1e-4, 1e3), random.unit(), random.unit());
        const vec3 c = rgb_to_ycocg(color);
        TaaBox box = taa_box_start(c);
        const vec3 value = taa_resolve(c, taa_clamp(box, c), 0.1f);
        worst.add(glm::length(value - color) / glm::length(color),
                  [&] { return fmt::format("{}", color.x); });
    }
    worst.report("taa", "still picture", 5e-7);
}

TEST(Light, ASunOfAMillionStaysFinite) {
    Worst worst;
    for (uint64_t i = 0; i < 200'000; ++i) {
        Random random(4, i);
        const ProbeInput p = extreme_input(random);
        const HairFrame f = hair_frame(p.tangent, p.to_view);
        const vec3 radiance = karis_direct(probe_surface(p), f, p.to_light, p.shadow) * 1e6f;
        const vec3 stored = taa_sanitize(radiance);
        const vec3 shown = display_color(radiance, 1.0f);
        for (int c = 0; c < 3; ++c) {
            worst.add(std::isfinite(radiance[c]) ? 0.0 : 1.0, [&] { return describe(p); });
            worst.add(std::max(stored[c] - 65504.0, 0.0), [&] { return describe(p); });
            worst.add(std::max(shown[c] - 1.0, 0.0), [&] { return describe(p); });
        }
    }
    worst.report("light", "sun 1e6: finite, half, display", 0.0);
}

TEST(Light, RingingBelowZeroIsCut) {
    Worst worst;
    for (uint64_t i = 0; i < 200'000; ++i) {
        Random random(5, i);
        Sh9 sh;
        for (auto& c : sh.c) c = vec3(random.range(-1e6, 1e6), random.range(-1.0, 1.0), 0.0);
        const vec3 n = vec3(random.direction()) * static_cast<float>(random.unit());
        const vec3 value = sh_irradiance_over_pi(sh, n);
        for (int c = 0; c < 3; ++c) {
            worst.add(std::isfinite(value[c]) ? std::max(-value[c], 0.0f) : 1.0,
                      [&] { return fmt::format("{}", value[c]); });
        }
    }
    worst.report("light", "SH ringing: >= 0", 0.0);
}

TEST(Light, NoLightIsBlack) {
    Random random(6, 0);
    const ProbeInput p = ordinary_input(random);
    const HairFrame f = hair_frame(p.tangent, p.to_view);
    const vec3 value = karis_environment(probe_surface(p), f, vec3(0.0f)) +
                       karis_direct(probe_surface(p), f, p.to_light, 0.0f) * 1e6f;
    report_row({"light", "no light: black", describe(p), glm::length(value), 0.0});
}

#ifdef __SSE2__
TEST(Denormals, FlushingThemChangesNothingVisible) {
    Worst worst;
    for (uint64_t i = 0; i < 400'000; ++i) {
        Random random(7, i);
        ProbeInput p = (i & 1) != 0 ? extreme_input(random) : ordinary_input(random);
        const ProbeOutput kept = probe(p, 1);
        const unsigned state = _mm_getcsr();
        _mm_setcsr(state | 0x8040u);  // flush-to-zero, denormals-are-zero
        const ProbeOutput flushed = probe(p, 1);
        _mm_setcsr(state);
        for (int row = 0; row < 5; ++row) {
            for (int c = 0; c < 3; ++c) {
                const double a = kept.value[row][c];
                const double b = flushed.value[row][c];
                worst.add(std::abs(a - b) / (1.0 + a), [&] { return describe(p); });
            }
        }
    }
    worst.report("denormals", "flush-to-zero on and off", 1.0 / 255.0);
}
#endif

TEST(Dither, ZeroNeverAndOneAlways) {
    Worst worst;
    for (uint64_t i = 0; i < 1'000'000; ++i) {
        Random random(8, i);
        const DitherStrand strand = dither_strand(static_cast<uint32_t>(random.bits()));
        const float t = dither_threshold(strand, uvec2(random.bits() % 4096, random.bits() % 4096),
                                         static_cast<uint32_t>(random.bits()));
        worst.add((dither_keeps(0.0f, t) || !dither_keeps(1.0f, t)) ? 1.0 : 0.0,
                  [&] { return fmt::format("{}", t); });
    }
    worst.report("opacity", "α = 0 and 1 exact", 0.0);
}

}  // namespace
}  // namespace vellus::test
