#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "tests/stability/frames.h"

// The scene walk for 600 frames, disturbed in every way there is, beside the same undisturbed.
namespace vellus::test {
namespace {

constexpr uint32_t kFrames = 600;
constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 54;

class WalkRun {
  public:
    explicit WalkRun(gpu::Device& device) {
        auto made = demo::Renderer::create(device, {});
        EXPECT_TRUE(made);
        renderer_ = std::move(*made);
        add_injection(world(), renderer_->schedule(), device);
        EXPECT_TRUE(renderer_->schedule().build(world()));
        demo::Options options;
        options.scene = demo::scene_folder() / "walk.gltf";
        options.size = {kWidth, kHeight};
        EXPECT_TRUE(demo::load_content(*renderer_, options));
        world().query<Entity, const scene::Light>().each(
            [&](Entity entity, const scene::Light& light) {
                sun_ = entity;
                sunlight_ = light;
            });
        world().query<Entity, const scene::ActiveCamera>().each(
            [&](Entity entity, const scene::ActiveCamera&) { camera_ = entity; });
    }

    World& world() { return renderer_->world(); }
    void draw(bool keep) {
        const auto drawn = renderer_->draw(keep ? demo::Output::kPixels : demo::Output::kNowhere);
        EXPECT_TRUE(drawn) << drawn.error().message();
        EXPECT_TRUE(renderer_->wait());
    }
    asset::Image picture() { return renderer_->pixels(); }

    void cut() { world().resource<scene::ViewSettings>().cut = true; }
    void inject(uint32_t frame) {
        constexpr uint16_t kGarbage[] = {0x7e00, 0x7c00, 0xfc00, 0xfe00, 0x7bff};
        const glm::uvec2 size = world().resource<scene::ViewSettings>().size;
        world().resource<Injection>().arm(glm::uvec2(frame * 29 % size.x, frame * 13 % size.y),
                                          kGarbage[frame / 7 % std::size(kGarbage)]);
    }
    void light(const glm::vec3& factor, float intensity) {
        auto* light = world().get<scene::Light>(sun_);
        light->color = sunlight_.color * factor;
        light->intensity = intensity;
    }
    void light_as_ever() { light(glm::vec3(1.0f), sunlight_.intensity); }
    /// Moves everything, the camera too.
    void move_scene(const glm::dvec3& by) {
        world().query<scene::LocalTransform, Without<scene::Parent>>().each(
            [&](scene::LocalTransform& transform) { transform.translation += by; });
        cut();
    }
    void move_camera(const glm::dvec3& by) {
        world().get<scene::LocalTransform>(camera_)->translation += by;
        cut();
    }
    void resize(uint32_t width, uint32_t height) { renderer_->resize(width, height); }

  private:
    std::unique_ptr<demo::Renderer> renderer_;
    Entity sun_ = kNoEntity;
    Entity camera_ = kNoEntity;
    scene::Light sunlight_;
};

/// What happens before this frame is drawn; all of it is over by frame 470.
void disturb(WalkRun& run, uint32_t frame) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    if (frame < 470 && frame % 7 == 3) run.inject(frame);
    const glm::dvec3 beside(1.5, 0.4, -1.0);
    const glm::dvec3 far(0.6, 0.0, -0.8);
    switch (frame) {
        case 60:
        case 200:
        case 420:
            return run.light(glm::vec3(1.0f), 1e6f);
        case 280:
            return run.light(glm::vec3(kNan, 1.0f, 1.0f), 3.0f);
        case 290:
            return run.light(glm::vec3(1.0f), -1e6f);
        case 70:
        case 210:
        case 281:
        case 291:
        case 430:
            return run.light_as_ever();
        case 120:
        case 425:
            return run.move_camera(beside);
        case 140:
        case 440:
            return run.move_camera(-beside);
        case 150:
            return run.resize(33, 17);
        case 160:
            return run.resize(1, 1);
        case 165:
            return run.resize(257, 3);
        case 170:
        case 465:
            return run.resize(kWidth, kHeight);
        case 455:
            return run.resize(48, 31);
        case 240:
            return run.move_scene(1e3 * far);
        case 260:
            return run.move_scene(-1e3 * far);
        case 300:
            return run.move_scene(1e5 * far);
        case 320:
            return run.move_scene(-1e5 * far);
        case 360:
            return run.move_scene(1e6 * far);
        case 380:
            return run.move_scene(-1e6 * far);
        default:
            return;
    }
}

struct Difference {
    double mean = 0.0;  ///< of 1
    double largest = 0.0;
    size_t at = 0;
};

Difference compare(const asset::Image& a, const asset::Image& b) {
    Difference difference;
    if (a.rgba.size() != b.rgba.size()) return {1.0, 1.0, 0};
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        const double off = std::abs(int{a.rgba[i]} - int{b.rgba[i]}) / 255.0;
        if (off > difference.largest) difference.at = i;
        difference.largest = std::max(difference.largest, off);
        difference.mean += off / static_cast<double>(a.rgba.size());
    }
    return difference;
}

using Walk = GpuTest;

TEST_F(Walk, SixHundredDisturbedFramesEndInTheSamePicture) {
    WalkRun calm(device());
    WalkRun disturbed(device());
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        disturb(disturbed, frame);
        calm.draw(frame + 1 == kFrames);
        disturbed.draw(frame + 1 == kFrames);
    }
    const asset::Image expected = calm.picture();
    const asset::Image picture = disturbed.picture();
    const auto [least, most] = std::ranges::minmax(expected.rgba);
    EXPECT_GT(most - least, 100) << "there is something to see";
    const Difference left = compare(picture, expected);
    const std::string where =
        fmt::format("byte {}: {} and {}", left.at, picture.rgba[left.at], expected.rgba[left.at]);
    // After 130 frames a history of half floats is within 8 of their steps of its mean, 0.8 %, and
    // a pixel that flickers forgets slowly: a bright frame weighs 1/(1 + Y);
    // single ones were 11 steps off.
    report_row({"walk", "600 frames disturbed: mean difference", where, left.mean, 0.25 / 255.0});
    // Nothing but histories may remember: after a cut the two are one.
    for (WalkRun* run : {&calm, &disturbed}) {
        run->cut();
        run->draw(true);
    }
    report_row({"walk", "600 frames disturbed, then a cut", "-",
                compare(disturbed.picture(), calm.picture()).largest, 0.0});
}

}  // namespace
}  // namespace vellus::test
