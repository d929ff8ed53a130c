#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/asset/gltf.h"
#include "engine/platform/files.h"
#include "modules/light/light_set.h"
#include "tests/stability/frames.h"
#include "tests/support/own_folder.h"

// Rows "coordinates", "depth", "exponential shadow", "light", "sizes" and "determinism" of the hard
// cases on whole frames.
namespace vellus::test {
namespace {

constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 64;
constexpr double kStep = 1.0 / 255.0;

using Frames = GpuTest;

TEST_F(Frames, FarFromTheOriginThePictureIsTheSame) {
    TuftScene here(device(), kWidth, kHeight);
    const Pixels expected = here.draw_frames(5);
    Worst worst;
    for (const double metres : {1e3, 1e5, 1e6}) {
        for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1),
                                     glm::dvec3(-0.7123, 0.3717, 0.5953)}) {
            TuftScene there(device(), kWidth, kHeight,
                            [&](TuftScene& scene) { scene.place(metres * way); });
            std::string where;
            const double error = display_error(there.draw_frames(5), expected, &where);
            worst.add(error, [&] {
                return fmt::format("{:g} m along ({} {} {}), {}", metres, way.x, way.y, way.z,
                                   where);
            });
        }
    }
    worst.report("coordinates", "moved by 1e3, 1e5, 1e6 m: same picture", kStep);
}

TEST_F(Frames, AnyNearPlaneAndHairThroughItIsFinite) {
    Worst worst;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float near_plane : {0.0f, 1e-42f, 0.6f, 1e20f, kInfinity}) {
        for (const double back : {0.0, -0.7}) {
            TuftScene scene(device(), kWidth, kHeight);
            scene.world.get<scene::Camera>(scene.camera)->near_plane = near_plane;
            scene.world.get<scene::LocalTransform>(scene.camera)->translation = {0, 0, back};
            worst.add(bad_values(scene.draw_frames(2)),
                      [&] { return fmt::format("near {:g}, camera at z {}", near_plane, back); });
        }
    }
    worst.report("depth", "near 0 ... Inf, hair through it: finite", 0.0);
}

TEST_F(Frames, HairBehindTheNearPlaneIsNotDrawn) {
    HairScene scene(device(), kWidth, kHeight);
    scene.add_sun({0, 0, 1});
    scene.add_hair(rooted_strands(wavy_tuft(100), 0.002f), plain_look());
    scene.world.get<scene::Camera>(scene.camera)->near_plane = 1.5f;
    scene.build();
    double lit = 0.0;
    for (const glm::vec4& pixel : scene.draw()) lit += pixel.g != 0.0f ? 1.0 : 0.0;
    report_row({"depth", "hair behind the near plane: pixels", "near 1.5 m", lit, 0.0});
}

/// A minimal file with one camera and one light, each changed by `edit`; what its reader says.
Result<asset::SceneAsset> load_edited(const std::function<void(nlohmann::json&)>& edit) {
    const OwnFolder folder("stability");
    nlohmann::json file = nlohmann::json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 9}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}}})");
    edit(file);
    const auto path = folder.path() / "edited.gltf";
    EXPECT_TRUE(write_file(path, std::string_view(file.dump())));
    return asset::load_gltf(path);
}

/// Refused, or read with a warning.
bool is_reported(const Result<asset::SceneAsset>& scene) {
    return !scene || !scene->warnings.empty();
}

TEST(Files, NearEqualToFarIsReported) {
    ASSERT_FALSE(is_reported(load_edited([](nlohmann::json&) {})));
    double silent = 0.0;
    for (const double far : {0.1, 0.05, 0.1 + 1e-12}) {
        silent += is_reported(load_edited([&](nlohmann::json& file) {
            file["cameras"][0]["perspective"]["zfar"] = far;
        }))
                      ? 0.0
                      : 1.0;
    }
    report_row({"depth", "near = far: said", "zfar <= znear in glTF", silent, 0.0});
}

TEST(Files, NegativeLightIsReported) {
    const auto light = [](nlohmann::json& file) -> nlohmann::json& {
        return file["extensions"]["KHR_lights_punctual"]["lights"][0];
    };
    double silent = 0.0;
    silent += is_reported(load_edited([&](nlohmann::json& f) { light(f)["intensity"] = -1.0; }))
                  ? 0.0
                  : 1.0;
    silent += is_reported(load_edited([&](nlohmann::json& f) {
        light(f)["color"] = {1, -1, 0};
    }))
                  ? 0.0
                  : 1.0;
    report_row({"light", "negative light: said", "glTF", silent, 0.0});
}

/// The tuft alone under one sun, without sky and TAA.
Pixels sunlit(gpu::Device& device, const glm::vec3& color, float intensity,
              const std::function<void(TuftScene&)>& more = {}) {
    TuftScene scene(device, kWidth, kHeight, [&](TuftScene& s) {
        s.world.resource<light::Environment>() = {};
        s.world.resource<temporal::TemporalSettings>().enabled = false;
        *s.world.get<scene::Light>(s.sun) = {
            .kind = asset::LightKind::kDirectional, .color = color, .intensity = intensity};
        if (more) more(s);
    });
    return scene.draw();
}

TEST_F(Frames, ASunOfAMillionIsClampedNotInfinite) {
    const Pixels picture = sunlit(device(), glm::vec3(1.0f), 1e6f);
    double most = 0.0;
    for (const glm::vec4& pixel : picture)
        most = std::max({most, double{pixel.g}, double{pixel.r}});
    report_row({"light", "sun 1e6 in half floats: not finite", "-", bad_values(picture), 0.0});
    report_row({"light", "sun 1e6 in half floats: largest", "-", most, 65504.0});
    EXPECT_GT(most, 100.0);
    // In the history it stays bright; infinity would be taken for garbage and left out.
    TuftScene scene(device(), kWidth, kHeight);
    scene.world.get<scene::Light>(scene.sun)->intensity = 1e6f;
    const Pixels shown = scene.draw_frames(3);
    double bright = 0.0;
    for (const glm::vec4& pixel : shown) bright += pixel.g > 10.0f ? 1.0 : 0.0;
    EXPECT_GT(bright, 100.0);
    report_row({"light", "sun 1e6 under TAA: not finite", "-", bad_values(shown), 0.0});
}

TEST_F(Frames, LightsThatAreNoneAreBlack) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::pair<glm::vec3, float> lights[] = {
        {glm::vec3(1.0f), 0.0f},  {glm::vec3(1.0f), -1.0f},   {glm::vec3(-1.0f), 1.0f},
        {glm::vec3(1.0f), kNan},  {{kNan, kNan, kNan}, 1.0f}, {{-1.0f, kNan, -1.0f}, 1.0f},
        {glm::vec3(-1.0f), -1e6f}};
    Worst worst;
    for (const auto& [color, intensity] : lights) {
        double lit = 0.0;
        const Pixels picture = sunlit(device(), color, intensity);
        for (const glm::vec4& p : picture) lit += p.r == 0.0f && p.g == 0.0f && p.b == 0.0f ? 0 : 1;
        worst.add(lit,
                  [&, c = color.x, i = intensity] { return fmt::format("colour {} x {}", c, i); });
    }
    worst.report("light", "no, negative or NaN light: lit pixels", 0.0);
}

TEST_F(Frames, AChannelThatIsNoNumberLeavesTheOthers) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Worst worst;
    for (const glm::vec3 color : {glm::vec3(1, kNan, 1), glm::vec3(kNan, 1, 1),
                                  glm::vec3(1, 1, kInfinity), glm::vec3(1e38f, 1, 1)}) {
        worst.add(bad_values(sunlit(device(), color, 1e6f)),
                  [&] { return fmt::format("{} {} {}", color.x, color.y, color.z); });
    }
    worst.report("light", "NaN, Inf in one channel: not finite", 0.0);
}

/// A curtain before the camera under one sun; `shading` hangs a second one 0.1 m closer to it. Lit
/// along kSlanted, rows 44 and 45 of 64 then show the first one through the light that passes
/// the second.
const glm::vec3 kSlanted = glm::normalize(glm::vec3(0, 1, 1));

Pixels curtain(gpu::Device& device, const glm::vec3& to_sun, bool shading, float falloff,
               uint32_t map,
               hair::ShadowTechnique technique = hair::ShadowTechnique::kPcfExponential) {
    const float pixel = 2.0f * std::tan(0.4f) / kHeight;
    HairScene scene(device, kWidth, kHeight);
    scene.add_sun(to_sun);
    scene.world.resource<light::ShadowSettings>().size = map;
    hair::HairExtension look = plain_look();
    look.material.scatter = 0.0f;
    for (const bool second : {false, true}) {
        if (second && !shading) continue;
        std::vector<std::vector<glm::vec3>> strands;
        const glm::vec3 towards = second ? to_sun * 0.1f : glm::vec3(0);
        for (int i = -15; i <= 15; ++i) {
            const float y = static_cast<float>(i) * pixel;
            strands.push_back(
                {glm::vec3(-0.3f, y, -1.0f) + towards, glm::vec3(0.3f, y, -1.0f) + towards});
        }
        const Entity hair =
            scene.add_hair(rooted_strands(strands, 2.0f * pixel), look, {.shadow = technique});
        scene.world.get<hair::HairShadow>(hair)->falloff = falloff;
    }
    scene.build();
    return scene.draw();
}

TEST_F(Frames, ReceiverBeforeItsCasterIsLit) {
    const Pixels lit = curtain(device(), {0, 0, 1}, false, 1e9f, 1024);
    const Pixels bare =
        curtain(device(), {0, 0, 1}, false, 1e9f, 1024, hair::ShadowTechnique::kNone);
    std::string where = "-";
    const double error = display_error(lit, bare, &where);
    report_row({"shadow, frames", "receiver at its caster: unshadowed", where, error, 0.0});
}

TEST_F(Frames, TenThousandFalloffsBehindIsBlack) {
    // falloff 1e5 over 0.1 m.
    const Pixels shaded = curtain(device(), kSlanted, true, 1e5f, 1024);
    const Pixels bare = curtain(device(), kSlanted, true, 1e5f, 1024, hair::ShadowTechnique::kNone);
    double light = 0.0;
    double unshaded = 0.0;
    // Away from the curtains' ends, where the filter sees past them.
    for (const size_t row : {44, 45}) {
        for (size_t column = 35; column < 61; ++column) {
            light += shaded[row * kWidth + column].g;
            unshaded += bare[row * kWidth + column].g;
        }
    }
    ASSERT_GT(unshaded, 0.0);
    report_row({"shadow, frames", "c dz = 1e4: light that passes", "-", light, 0.0});
}

TEST_F(Frames, AMapOfOneTexelIsFinite) {
    Worst worst;
    for (const uint32_t size : {0u, 1u, 2u}) {
        const Pixels picture = curtain(device(), kSlanted, true, 80.0f, size);
        const Pixels bare =
            curtain(device(), kSlanted, true, 80.0f, size, hair::ShadowTechnique::kNone);
        double brighter = bad_values(picture);
        for (size_t i = 0; i < picture.size(); ++i) {
            brighter += picture[i].g > bare[i].g ? 1.0 : 0.0;
        }
        worst.add(brighter, [&] { return fmt::format("map of {}", size); });
    }
    worst.report("shadow, frames", "map of 0, 1, 2 texels: finite, darker", 0.0);
}

TEST_F(Frames, PicturesOfAnySizeAreDrawn) {
    Worst worst;
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(1, 7), glm::uvec2(7, 1),
                                  glm::uvec2(33, 17), glm::uvec2(65, 63), glm::uvec2(257, 3)}) {
        TuftScene scene(device(), size.x, size.y);
        const Pixels picture = scene.draw_frames(3);
        worst.add(bad_values(picture) + (picture.size() == size_t{size.x} * size.y ? 0.0 : 1.0),
                  [&] { return fmt::format("{}x{}", size.x, size.y); });
    }
    worst.report("sizes", "1x1, odd: not finite", 0.0);
}

TEST_F(Frames, NoStrandAndOneStrand) {
    for (const size_t count : {0, 1}) {
        TuftScene scene(device(), kWidth, kHeight, [&](TuftScene& s) {
            s.world.destroy(s.tuft);
            s.add_hair(rooted_strands(wavy_tuft(count), 0.01f), plain_look());
        });
        const Pixels picture = scene.draw_frames(3);
        TuftScene bare(device(), kWidth, kHeight, [](TuftScene& s) { s.world.destroy(s.tuft); });
        const double changed = display_error(picture, bare.draw_frames(3));
        report_row(
            {"sizes", fmt::format("{} strands: not finite", count), "-", bad_values(picture), 0.0});
        EXPECT_EQ(changed > 0.0, count == 1);
    }
}

TEST_F(Frames, FourMillionStrandsAreDrawn) {
    // More segments (8.4 M) than one row of work groups covers (4.2 M): the last strand must show.
    constexpr size_t kStrands = 4'200'000;
    hair::Groom groom;
    groom.points.reserve(3 * kStrands);
    groom.strand_begin.reserve(kStrands + 1);
    for (size_t s = 0; s < kStrands; ++s) {
        // A grid of 2050 x 2049 strands, each a thousandth as long as the picture is high.
        const size_t row = s / 2050;
        const auto x = static_cast<float>(s % 2050) / 2050.0f - 0.5f;
        const auto y = static_cast<float>(row) / 2049.0f - 0.5f;
        const glm::vec3 root(0.8f * x, 0.8f * y, -1.0f);
        for (int i = 0; i < 3; ++i) {
            groom.points.push_back(root + glm::vec3(0.0004f * static_cast<float>(i), 0, 0));
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    const hair::StrandData strands = hair::prepare_strands(groom, glm::dmat4(1.0), 0.01f);
    ASSERT_GT(strands.segment_count(), size_t{65535} * 64 * 2 - 1);
    HairScene scene(device(), kWidth, kHeight);
    scene.add_sun({0, 0, 1});
    const Entity hair =
        scene.add_hair(strands, plain_look(), {.shadow = hair::ShadowTechnique::kNone});
    scene.world.add(hair, hair::HairDetail{.share = 1.0f});
    scene.build();
    const Pixels picture = scene.draw();
    double missing = bad_values(picture);
    // The grid fills the middle 60 rows and columns of a picture 0.845 m high.
    for (uint32_t y = 4; y < 60; ++y) {
        for (uint32_t x = 20; x < 76; ++x) missing += picture[y * kWidth + x].g > 0.0f ? 0.0 : 1.0;
    }
    report_row({"sizes", "4.2 M strands, 8.4 M segments: holes", "-", missing, 0.0});
}

TEST_F(Frames, TheSameTwiceIsBitIdentical) {
    double different = 0.0;
    std::vector<Pixels> pictures;
    for (int run = 0; run < 3; ++run) {
        TuftScene scene(device(), kWidth, kHeight);
        pictures.push_back(scene.draw_frames(6));
    }
    for (const Pixels& picture : pictures) different += picture == pictures[0] ? 0.0 : 1.0;
    report_row({"determinism", "same seed, same device: other pictures", "-", different, 0.0});
}

}  // namespace
}  // namespace vellus::test
