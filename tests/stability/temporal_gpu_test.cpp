#include <fmt/format.h>

#include <cmath>

#include "tests/stability/frames.h"

// Row "TAA" of the hard cases on whole frames: what reaches the history, and what leaves it.
namespace vellus::test {
namespace {

constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 64;
constexpr double kStep = 1.0 / 255.0;

using TemporalFrames = GpuTest;

double largest_difference(const Pixels& a, const Pixels& b) {
    if (a.size() != b.size()) return 1.0;
    double worst = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double off = std::abs(double{a[i][c]} - b[i][c]);
            worst = std::max(worst, std::isfinite(off) ? off : 1.0);
        }
    }
    return worst;
}

/// The first frame of a scene that begins at this frame of the dither and the jitter.
Pixels fresh(gpu::Device& device, uint64_t frame, uint32_t width, uint32_t height,
             const std::function<void(TuftScene&)>& set_up = {}) {
    TuftScene scene(device, width, height, set_up);
    scene.world.resource<scene::FixedStep>().frame = frame;
    return scene.draw();
}

TEST_F(TemporalFrames, GarbageInOnePixelIsGoneWithinEightFrames) {
    struct Garbage {
        const char* name;
        uint16_t half;
    };
    constexpr Garbage kGarbage[] = {{"NaN", 0x7e00},   {"+Inf, 1e6", 0x7c00}, {"-Inf", 0xfc00},
                                    {"65504", 0x7bff}, {"60000", 0x7b53},     {"-60000", 0xfb53}};
    Worst highlight;
    Worst worst;
    const auto add = [&](TuftScene& scene) {
        add_injection(scene.world, scene.schedule, device());
    };
    const Pixels expected = TuftScene(device(), kWidth, kHeight, add).draw_frames(15);
    for (const Garbage& garbage : kGarbage) {
        for (const glm::uvec2 pixel : {glm::uvec2(48, 30), glm::uvec2(95, 63)}) {
            TuftScene broken(device(), kWidth, kHeight, add);
            broken.draw_frames(6);
            broken.world.resource<Injection>().arm(pixel, garbage.half);
            worst.add(bad_values(broken.draw()), [&] { return std::string(garbage.name); });
            std::string where;
            const double error = display_error(broken.draw_frames(8), expected, &where);
            (garbage.half == 0x7b53 ? highlight : worst).add(error, [&] {
                return fmt::format("{}, {}", garbage.name, where);
            });
        }
    }
    worst.report("taa, frames", "NaN, Inf, 1e6: left after 8 frames", kStep);
    // The brightest that shading writes is a highlight like any other: its luminance is clamped to
    // 1024, where taa_weight leaves a 17,000th of it; what of that the neighbourhood's bounds let
    // pass fades by 0.94 a frame.
    highlight.report("taa, frames", "60000, a highlight: left after 8", 2.0 * kStep);
}

TEST_F(TemporalFrames, TheFirstFrameIsTheFrameAlone) {
    TuftScene with(device(), kWidth, kHeight);
    const Pixels shown = with.draw();
    TuftScene without(device(), kWidth, kHeight, [](TuftScene& scene) {
        scene.world.resource<temporal::TemporalSettings>().blend = 1.0f;
    });
    // YCoCg and back, then half floats.
    std::string where = "-";
    const double error = display_error(shown, without.draw(), &where);
    report_row({"taa, frames", "first frame", where, error, 1e-3});
}

TEST_F(TemporalFrames, ACutStartsAnew) {
    TuftScene scene(device(), kWidth, kHeight);
    scene.draw_frames(9);
    scene.world.get<scene::LocalTransform>(scene.camera)->translation = {0.1, 0.05, -0.1};
    const Pixels cut = scene.draw_cut();
    const Pixels expected = fresh(device(), 9, kWidth, kHeight, [](TuftScene& other) {
        other.world.get<scene::LocalTransform>(other.camera)->translation = {0.1, 0.05, -0.1};
    });
    report_row({"taa, frames", "camera cut: as a first frame", "-",
                largest_difference(cut, expected), 0.0});
}

TEST_F(TemporalFrames, AResizeStartsAnew) {
    TuftScene scene(device(), kWidth, kHeight);
    Worst worst;
    uint64_t frame = 0;
    for (const glm::uvec2 size : {glm::uvec2(96, 64), glm::uvec2(33, 17), glm::uvec2(1, 1),
                                  glm::uvec2(64, 96), glm::uvec2(96, 64)}) {
        scene.world.resource<scene::ViewSettings>().size = size;
        // Nobody says that this is a cut; the history's size does.
        const Pixels resized = scene.draw();
        worst.add(bad_values(resized), [&] { return fmt::format("{}x{}", size.x, size.y); });
        const Pixels expected = fresh(device(), frame, size.x, size.y);
        const double error = display_error(resized, expected);
        worst.add(error, [&] { return fmt::format("{}x{}", size.x, size.y); });
        scene.draw_frames(3);
        frame += 4;
    }
    worst.report("taa, frames", "resize: as a first frame", 0.0);
}

TEST_F(TemporalFrames, WhereNothingWasSeenBeforeThereIsNoHistory) {
    // A turn by 60° brings in nothing that a picture 46° wide and high has shown.
    const auto turn = [](TuftScene& scene) {
        scene.world.get<scene::LocalTransform>(scene.camera)->rotation =
            glm::angleAxis(1.0472f, glm::vec3(0, 1, 0));
    };
    const auto beside = [](TuftScene& scene) {
        const Entity second = scene.add_hair(rooted_strands(wavy_tuft(200), 0.002f), plain_look());
        scene.world.get<scene::LocalTransform>(second)->translation = {-0.6, 0.0, 0.35};
    };
    TuftScene scene(device(), kHeight, kHeight, beside);
    scene.draw_frames(6);
    turn(scene);
    const Pixels turned = scene.draw();
    const Pixels expected = fresh(device(), 6, kHeight, kHeight, [&](TuftScene& other) {
        beside(other);
        turn(other);
    });
    report_row({"taa, frames", "all disoccluded: as a first frame", "-",
                largest_difference(turned, expected), 0.0});
}

TEST_F(TemporalFrames, AlphaZeroIsThePictureWithoutTheHair) {
    TuftScene without(device(), kWidth, kHeight);
    TuftScene with(device(), kWidth, kHeight, [](TuftScene& scene) {
        hair::HairExtension clear = plain_look();
        clear.material.alpha = 0.0f;
        scene.add_hair(rooted_strands(wavy_tuft(200, 12, 2), 0.004f), clear);
    });
    double worst = 0.0;
    for (int frame = 0; frame < 6; ++frame) {
        worst = std::max(worst, largest_difference(with.draw(), without.draw()));
    }
    report_row({"taa, frames", "alpha 0: bit-identical to without", "-", worst, 0.0});
}

TEST_F(TemporalFrames, AlphaOneIsExact) {
    // A wall of strands wider than pixels: without TAA every frame is the same to the bit, whatever
    // its dither, and no pixel shows what is behind.
    HairScene scene(device(), kWidth, kHeight);
    scene.add_sun({0, 0, 1});
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < 20; ++i) {
        const float y = 0.1f * static_cast<float>(i) - 1.0f;
        strands.push_back({{-2.0f, y, -1.0f}, {2.0f, y, -1.0f}});
    }
    // Strands overlap by half: where one's edge is dithered, its neighbour is whole.
    scene.add_hair(rooted_strands(strands, 0.2f), plain_look());
    scene.build();
    double holes = 0.0;
    for (int frame = 0; frame < 16; ++frame) {
        for (const glm::vec4& pixel : scene.draw()) holes += pixel.g > 0.0f ? 0.0 : 1.0;
    }
    report_row({"taa, frames", "alpha 1: pixels that show through", "-", holes, 0.0});
}

/// Grey strands a tenth of a pixel wide over black: in most frames most pixels show none.
struct ThinHair : HairScene {
    explicit ThinHair(gpu::Device& device, bool temporal) : HairScene(device, kWidth, kHeight) {
        world.resource<temporal::TemporalSettings>().enabled = temporal;
        add_sun(glm::normalize(glm::vec3(0.3f, 0.6f, 0.8f)));
        hair = add_hair(rooted_strands(wavy_tuft(60), 0.0008f), plain_look());
        build();
    }
    /// The frames' mean light in the picture.
    double light(int frames) {
        double sum = 0.0;
        for (int frame = 0; frame < frames; ++frame) {
            for (const glm::vec4& pixel : draw()) sum += double{pixel.g} / frames;
        }
        return sum;
    }
    Entity hair;
};

TEST_F(TemporalFrames, ThinHairKeepsItsCoverage) {
    // Without TAA dither is right in the mean; 256 frames of some thousand strand pixels know it
    // within a hundredth, and 48 frames of a history that is 16 frames long about as well. Strands
    // far from others are missing from four frames of a window now and then, and start anew.
    const double expected = ThinHair(device(), false).light(256);
    ThinHair smooth(device(), true);
    smooth.light(48);
    const double shown = smooth.light(48);
    ASSERT_GT(expected, 1.0);
    report_row({"taa, frames", "light of thin hair", fmt::format("{:+.4f}", shown / expected - 1.0),
                std::abs(shown / expected - 1.0), 0.1});
}

TEST_F(TemporalFrames, HairThatHasGoneLeavesNoGhost) {
    ThinHair scene(device(), true);
    scene.light(32);
    scene.world.get<scene::LocalTransform>(scene.hair)->translation = {50.0, 0.0, 0.0};
    // Three frames of memory (kTaaForget), then the box of a picture that is black.
    scene.light(4);
    double left = 0.0;
    for (const glm::vec4& pixel : scene.draw()) left = std::max(left, double{pixel.g});
    report_row({"taa, frames", "hair that has gone: left after 5", "-", left, kStep});
}

}  // namespace
}  // namespace vellus::test
