#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "engine/platform/jobs.h"
#include "modules/hair/reference/visibility.h"
#include "tests/stability/cases.h"
#include "tests/stability/report.h"
#include "tests/stability/shading_functions.h"

// Rows "invariance" and "visibility functions" of the hard cases, on the functions themselves.
namespace vellus::test {
namespace {

using hair::reference::RoundSegment;
using hair::reference::Transmittance;
using hair::reference::transmittance_along;

constexpr double kInvariant = 1e-5;

/// Strands across the z axis, each of a few pieces.
std::vector<RoundSegment> random_strands(uint64_t seed, uint32_t count) {
    std::vector<RoundSegment> segments;
    for (uint32_t s = 0; s < count; ++s) {
        Random random(seed, s);
        glm::dvec3 at(random.range(-1.0, -0.5), random.range(-0.3, 0.3), random.range(0.0, 5.0));
        for (int piece = 0; piece < 4; ++piece) {
            const glm::dvec3 next =
                at + glm::dvec3(0.4, random.range(-0.2, 0.2), random.range(-0.2, 0.2));
            segments.push_back({at, next, 0.05, 0.05, 0.02 + 0.9 * random.unit(), s});
            at = next;
        }
        for (int piece = 1; piece < 4; ++piece) {
            segments[segments.size() - piece].opacity = segments[segments.size() - 4].opacity;
        }
    }
    return segments;
}

/// Largest difference of two transmittances over depths, relative to the first.
double difference(const Transmittance& a, const Transmittance& b) {
    double worst = 0.0;
    for (int i = 0; i <= 600; ++i) {
        const double depth = 0.01 * i + 0.00317;
        worst = std::max(worst, std::abs(a.at(depth) - b.at(depth)) / (a.at(depth) + 1e-12));
    }
    return worst;
}

template <class Change>
void expect_same(const char* test, const Change& change) {
    Worst worst;
    for (uint64_t seed = 0; seed < 200; ++seed) {
        const auto strands = random_strands(seed, 40);
        const auto changed = change(strands, seed);
        const glm::dvec3 origin(0.0, 0.0, -1.0);
        const glm::dvec3 ahead(0.0, 0.0, 1.0);
        worst.add(difference(transmittance_along(strands, origin, ahead),
                             transmittance_along(changed, origin, ahead)),
                  [&] { return fmt::format("40 strands, seed {}", seed); });
    }
    worst.report("invariance", test, kInvariant);
}

TEST(Invariance, TransmittanceOfPermutedStrands) {
    expect_same("strands permuted: transmittance", [](auto strands, uint64_t seed) {
        for (size_t i = strands.size() - 1; i > 0; --i) {
            std::swap(strands[i], strands[Random(seed + 1000, i).bits() % (i + 1)]);
        }
        return strands;
    });
}

TEST(Invariance, TransmittanceOfSplitSegments) {
    expect_same("segments split: transmittance", [](const auto& strands, uint64_t seed) {
        std::vector<RoundSegment> split;
        for (size_t i = 0; i < strands.size(); ++i) {
            const RoundSegment& whole = strands[i];
            const glm::dvec3 middle =
                glm::mix(whole.a, whole.b, Random(seed + 2000, i).range(0.1, 0.9));
            split.push_back(whole);
            split.back().b = middle;
            split.push_back(whole);
            split.back().a = middle;
        }
        return split;
    });
}

TEST(Invariance, HalfTheOpticalDepthTwiceAsOften) {
    // 1 - α' = √(1 - α): half of -ln(1 - α).
    expect_same("half alpha, twice the fragments", [](const auto& strands, uint64_t) {
        std::vector<RoundSegment> twice;
        for (const RoundSegment& strand : strands) {
            RoundSegment half = strand;
            half.opacity = 1.0 - std::sqrt(1.0 - strand.opacity);
            twice.push_back(half);
            half.strand = strand.strand + 1000;
            twice.push_back(half);
        }
        return twice;
    });
}

TEST(Invariance, HalfTheFalloffTwiceAsDeep) {
    Worst worst;
    for (uint64_t i = 0; i < 1'000'000; ++i) {
        Random random(9, i);
        const auto falloff = static_cast<float>(random.log_range(0.1, 1e3));
        const auto depth = static_cast<float>(random.range(0.0, 60.0 / falloff));
        const double once = hair::probe::exponential_transmittance(depth, 0.0f, falloff);
        const double half =
            hair::probe::exponential_transmittance(2.0f * depth, 0.0f, 0.5f * falloff);
        const double twice = hair::probe::exponential_transmittance(depth, 0.0f, 0.5f * falloff);
        worst.add(std::max(std::abs(half / once - 1.0), std::abs(twice * twice / once - 1.0)),
                  [&] { return fmt::format("falloff {} depth {}", falloff, depth); });
    }
    worst.report("invariance", "half the falloff twice as deep", kInvariant);
}

/// One of the 24 rotations of a cube, which floats take without rounding.
glm::vec3 turned(const glm::vec3& v, uint64_t which) {
    glm::vec3 r = v;
    for (uint64_t i = 0; i < which % 3; ++i) r = {r.y, r.z, r.x};
    if (which / 3 % 2 != 0) r = {r.x, -r.y, -r.z};
    if (which / 6 % 2 != 0) r = {-r.x, r.y, -r.z};
    if (which / 12 % 2 != 0) r = {-r.x, r.z, r.y};
    return r;
}

TEST(Invariance, ShadingTurnedWithEverythingElse) {
    // In double: what is left is the formulas' own dependence on the axes.
    constexpr std::array kTurned = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 17, 18};
    std::mutex mutex;
    Worst worst;
    parallel_ranges(200'000, 4096, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            Random random(61, i);
            const ProbeInput p = ordinary_input(random);
            const int function = kTurned[i % kTurned.size()];
            if (function == kDeonFunction && i % 8 != 0) continue;
            ShadingInput input{
                p.color,    p.tangent,  p.to_light,
                p.to_view,  p.history,  p.roughness,
                p.specular, p.scatter,  p.shift,
                p.shadow,   p.receiver, p.occluder,
                p.falloff,  p.blend,    fibre_floats(i % kFibres, p.roughness, p.shift)};
            const glm::dvec4 before = in_double::evaluate(function, input);
            const uint64_t which = random.bits() % 24;
            for (glm::vec3* v : {&input.tangent, &input.to_light, &input.to_view}) {
                *v = turned(*v, which);
            }
            const glm::dvec4 after = in_double::evaluate(function, input);
            double error = 0.0;
            for (int c = 0; c < 3; ++c) {
                error = std::max(error, std::abs(after[c] - before[c]) / (before[c] + 1e-6));
            }
            const std::scoped_lock lock(mutex);
            worst.add(error, [&] {
                return fmt::format("{}: {}", kShadingFunctions[function], describe(p));
            });
        }
    });
    worst.report("invariance", "all turned: shading", kInvariant);
}

TEST(VisibilityFunction, StepsAndEnds) {
    const glm::dvec3 origin(0.0, 0.0, -1.0);
    const glm::dvec3 ahead(0.0, 0.0, 1.0);
    const auto strand_at = [](double depth, double opacity, uint32_t strand) {
        return RoundSegment{{-1, 0, depth}, {1, 0, depth}, 0.01, 0.01, opacity, strand};
    };
    report_row({"visibility", "empty ray: 1", "-",
                std::abs(transmittance_along({}, origin, ahead).at(1e9) - 1.0), 0.0});
    const std::vector one = {strand_at(0.0, 0.5, 0)};
    const Transmittance single = transmittance_along(one, origin, ahead);
    report_row({"visibility", "1 fragment: a step", "-",
                std::abs(single.at(0.9) - 1.0) + std::abs(single.at(1.1) - 0.5), 0.0});
    const std::vector opaque = {strand_at(0.0, 1.0, 0), strand_at(1.0, 0.0, 1)};
    report_row({"visibility", "alpha 1, then alpha 0: 0", "-",
                transmittance_along(opaque, origin, ahead).at(3.0), 0.0});
    std::vector<RoundSegment> same;
    for (uint32_t s = 0; s < 64; ++s) same.push_back(strand_at(0.5, 0.25, s));
    report_row(
        {"visibility", "all depths equal: the product", "64 strands",
         std::abs(transmittance_along(same, origin, ahead).at(3.0) / std::pow(0.75, 64) - 1.0),
         kInvariant});
    std::vector<RoundSegment> many;
    for (uint32_t s = 0; s < 10'000; ++s) many.push_back(strand_at(0.001 * s, 1e-3, s));
    report_row(
        {"visibility", "1e4 layers: the product", "alpha 1e-3",
         std::abs(transmittance_along(many, origin, ahead).at(1e3) / std::pow(1.0 - 1e-3, 10'000) -
                  1.0),
         kInvariant});
}

}  // namespace
}  // namespace vellus::test
