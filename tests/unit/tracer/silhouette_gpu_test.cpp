#include <gtest/gtest.h>

#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "game_demo/tools/reference/reference.h"
#include "modules/hair/reference/tracer/render.h"
#include "modules/light/environment.h"
#include "tests/support/gpu_fixture.h"

namespace vellus::demo {
namespace {

class SilhouetteTest : public vellus::test::GpuTest {};

constexpr uint32_t kWidth = 160;
constexpr uint32_t kHeight = 120;
constexpr uint32_t kFrame = 3;

using Mask = std::vector<bool>;

Mask at_least(const std::vector<double>& coverage, double share) {
    Mask mask(coverage.size());
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = coverage[i] >= share;
    return mask;
}

/// Pixels of `mask` that have no pixel of `other` within one pixel.
int beyond_a_pixel(const Mask& mask, const Mask& other) {
    int count = 0;
    for (int y = 0; y < static_cast<int>(kHeight); ++y) {
        for (int x = 0; x < static_cast<int>(kWidth); ++x) {
            if (!mask[y * kWidth + x]) continue;
            bool near = false;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, int{kHeight} - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, int{kWidth} - 1); ++u) {
                    near = near || other[v * kWidth + u];
                }
            }
            count += near ? 0 : 1;
        }
    }
    return count;
}

/// Share of frames in which the demo draws anything in a pixel; time stands still at kFrame.
std::vector<double> demo_coverage(gpu::Device& device, const Options& options) {
    auto renderer = Renderer::create(device, {});
    EXPECT_TRUE(renderer);
    EXPECT_TRUE(load_content(**renderer, options));
    World& world = (*renderer)->world();
    // Nothing behind the scene: what is not black was drawn. It still lights everything.
    world.resource<light::Environment>().drawn = false;
    for (uint32_t frame = 0; frame < kFrame; ++frame) {
        EXPECT_TRUE((*renderer)->draw(Output::kNowhere));
    }
    world.resource<scene::FixedStep>().dt = 0.0;
    constexpr int kFrames = 24;  // of the dither, which evens out over 16
    std::vector<double> share(size_t{kWidth} * kHeight);
    for (int frame = 0; frame < kFrames; ++frame) {
        EXPECT_TRUE((*renderer)->draw(Output::kPixels));
        EXPECT_TRUE((*renderer)->wait());
        const asset::Image image = (*renderer)->pixels();
        for (size_t i = 0; i < share.size(); ++i) {
            const bool drawn =
                image.rgba[4 * i] + image.rgba[4 * i + 1] + image.rgba[4 * i + 2] > 0;
            share[i] += drawn ? 1.0 / kFrames : 0.0;
        }
    }
    return share;
}

TEST_F(SilhouetteTest, OfDemoAndReferenceAgreeWithinAPixel) {
    ReferenceOptions options;
    options.content.size = {kWidth, kHeight};
    options.content.no_taa = true;
    options.frame = kFrame;
    const std::vector<double> demo = demo_coverage(device(), options.content);

    auto loaded = load_reference(options);
    ASSERT_TRUE(loaded) << loaded.error().message();
    auto tracer = hair::tracer::PathTracer::create(std::move(loaded->scene), {.max_depth = 1});
    ASSERT_TRUE(tracer);
    hair::tracer::Film film({kWidth, kHeight});
    hair::tracer::add_samples(**tracer, 0, 32, film, false);
    std::vector<double> reference(demo.size());
    int covered = 0;
    for (size_t i = 0; i < reference.size(); ++i) {
        reference[i] = film.coverage(i);
        covered += reference[i] > 0.5 ? 1 : 0;
    }
    EXPECT_GT(covered, 4000);
    // A pixel that is surely covered in one is at least partly so in the other, a pixel off at
    // most: between the two shares lie wisps, whose share the dither and 32 rays know to some
    // tenths.
    EXPECT_EQ(beyond_a_pixel(at_least(reference, 0.6), at_least(demo, 0.3)), 0);
    EXPECT_EQ(beyond_a_pixel(at_least(demo, 0.6), at_least(reference, 0.3)), 0);
    // A picture shifted by three pixels does not pass.
    std::vector<double> shifted(demo.size());
    std::copy(demo.begin(), demo.end() - 3, shifted.begin() + 3);
    EXPECT_GT(beyond_a_pixel(at_least(shifted, 0.6), at_least(reference, 0.3)), 50);
}

}  // namespace
}  // namespace vellus::demo
