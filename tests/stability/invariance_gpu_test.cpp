#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "modules/light/environment.h"
#include "tests/stability/frames.h"
#include "tests/support/sampling.h"

// Row "invariance" of the hard cases on whole frames: what must not change the picture.
namespace vellus::test {
namespace {

constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 96;
constexpr float kStrandWidth = 0.02f;  // 2 pixels: dither decides at edges only

using InvariantFrames = GpuTest;

Pixels draw(gpu::Device& device, const hair::StrandData& strands,
            const hair::HairTechniques& techniques = {}) {
    HairScene scene(device, kWidth, kHeight);
    scene.add_sun(glm::normalize(glm::vec3(0.3f, 0.6f, 0.8f)));
    scene.add_hair(strands, plain_look(), techniques);
    scene.build();
    return scene.draw();
}

double relative_difference(const Pixels& a, const Pixels& b, double* share = nullptr) {
    double worst = a.size() == b.size() ? 0.0 : 1.0;
    double different = 0.0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        double here = 0.0;
        for (int c = 0; c < 3; ++c) {
            here = std::max(here, std::abs(double{a[i][c]} - b[i][c]) /
                                      (std::max(std::abs(a[i][c]), std::abs(b[i][c])) + 1e-4));
        }
        worst = std::max(worst, here);
        different += here > 1e-3 ? 1.0 : 0.0;
    }
    if (share) *share = different / static_cast<double>(a.size());
    return worst;
}

TEST_F(InvariantFrames, TheOrderOfStrandsDoesNotMatter) {
    auto strands = wavy_tuft(200);
    const Pixels expected = draw(device(), rooted_strands(strands, kStrandWidth));
    Worst worst;
    for (uint64_t round = 0; round < 3; ++round) {
        for (size_t i = strands.size() - 1; i > 0; --i) {
            std::swap(strands[i], strands[Random(round, i).bits() % (i + 1)]);
        }
        worst.add(
            relative_difference(draw(device(), rooted_strands(strands, kStrandWidth)), expected),
            [&] { return fmt::format("permutation {}", round); });
    }
    worst.report("invariance", "strands permuted: same picture", 1e-5);
}

TEST_F(InvariantFrames, SplittingSegmentsDoesNotMatter) {
    // Points on a grid of powers of two, so that a middle is exactly between its neighbours.
    std::vector<std::vector<glm::vec3>> whole;
    std::vector<std::vector<glm::vec3>> split;
    for (size_t s = 0; s < 60; ++s) {
        Random random(5, s);
        const auto on_grid = [&](double low, double high) {
            return static_cast<float>(std::round(random.range(low, high) * 1024.0) / 1024.0);
        };
        // Straight: tangents are smoothed over bends.
        const glm::vec3 root(on_grid(-0.25, 0.25), on_grid(0.1, 0.25), on_grid(-0.9, -0.7));
        const glm::vec3 tip(on_grid(-0.25, 0.25), on_grid(-0.25, -0.1), on_grid(-0.9, -0.7));
        whole.push_back({root, tip});
        split.push_back({root, 0.5f * (root + tip), tip});
    }
    double share = 0.0;
    relative_difference(draw(device(), rooted_strands(whole, kStrandWidth)),
                        draw(device(), rooted_strands(split, kStrandWidth)), &share);
    // A halved segment steps from its own end: an edge within the rounding of a pixel centre, or a
    // shadow texel whose depth rounds, falls the other way here and there.
    report_row({"invariance", "segments split: share of other pixels", "60 strands", share, 0.005});
}

TEST_F(InvariantFrames, TurningEverythingTogetherDoesNotMatter) {
    // Quarter turns are exact in floats but for the order of sums.
    std::vector<Pixels> pictures;
    for (int quarter = 0; quarter < 4; ++quarter) {
        HairScene scene(device(), kWidth, kHeight);
        const double angle = quarter * 1.5707963267948966;
        const glm::quat turn = glm::angleAxis(static_cast<float>(angle), glm::vec3(0, 1, 0));
        asset::ImageF sky{.width = 32, .height = 16, .rgba = {}};
        for (uint32_t i = 0; i < sky.width * sky.height; ++i) {
            const float across = static_cast<float>(i % sky.width) / 32.0f;
            sky.rgba.insert(sky.rgba.end(), {across, 0.4f, 1.0f - across, 1.0f});
        }
        auto around = light::make_environment(device(), sky, 1.0f, static_cast<float>(angle));
        ASSERT_TRUE(around);
        scene.world.resource<light::Environment>() = std::move(*around);
        scene.add_sun(turn * glm::normalize(glm::vec3(0.3f, 0.6f, 0.8f)));
        const Entity hair = scene.add_hair(rooted_strands(wavy_tuft(200), kStrandWidth),
                                           plain_look(), {.shadow = hair::ShadowTechnique::kNone});
        for (const Entity entity : {hair, scene.camera}) {
            scene.world.get<scene::LocalTransform>(entity)->rotation = turn;
        }
        scene.build();
        pictures.push_back(scene.draw());
    }
    Worst worst;
    for (size_t i = 1; i < pictures.size(); ++i) {
        double share = 0.0;
        relative_difference(pictures[i], pictures[0], &share);
        worst.add(share, [&] { return fmt::format("{} degrees", 90 * i); });
    }
    // Half floats hold 5e-4; pixels on an edge may round to the other side.
    worst.report("invariance", "all turned: share of other pixels", 0.005);
}

}  // namespace
}  // namespace vellus::test
