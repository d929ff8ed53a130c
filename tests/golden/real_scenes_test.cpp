#include <gtest/gtest.h>

#include <algorithm>

#include "tests/golden/picture.h"
#include "tests/golden/real_scenes.h"

// Real grooms and characters: what must hold whatever the picture looks like in detail.
namespace vellus {
namespace {

namespace fs = std::filesystem;

const fs::path kData = VELLUS_TEST_DATA;

#define REQUIRE_DATA() \
    if (!fs::exists(kData)) GTEST_SKIP() << "no real files at " << kData

/// The picture, and the same without its hair: a groom whose strands are fully clear.
struct Pair {
    std::vector<asset::Image> with;
    std::vector<asset::Image> without;
};

Pair draw(const std::string& name, const std::string& glb, const std::string& node,
          const nlohmann::json& hair, const std::vector<std::string>& arguments,
          const std::function<void(nlohmann::json&)>& edit = {}) {
    nlohmann::json clear = hair;
    clear["material"]["alpha"] = 0.0;
    const auto run = [&](const std::string& scene_name, const nlohmann::json& look) {
        std::vector<std::string> all = {
            test::scene_with_hair(scene_name, kData / "gltf" / glb, node, look, edit).string()};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return test::render(scene_name, all);
    };
    return {run(name, hair), run(name + "_bald", clear)};
}

const nlohmann::json kSintelHair = {
    {"groom", (kData / "hair/SintelHairOriginal.16points.tfx").string()},
    {"upright", false},
    {"width", {{"root", 0.00025}, {"tip_scale", 0.4}}},
    {"material", {{"melanin", {{"eumelanin", 1.3}, {"pheomelanin", 1.0}}}, {"roughness", 0.3}}}};

size_t area(const std::vector<uint8_t>& mask) {
    return static_cast<size_t>(std::ranges::count(mask, uint8_t{1}));
}

TEST(RealScenes, SintelWearsHerHairWithoutHolesOrShimmer) {
    REQUIRE_DATA();
    const Pair pair =
        draw("sintel", "sintel_bust.glb", "sintel.obj", kSintelHair,
             {"--size", "480x360", "--frames", "40", "--save", "32,33,34,35,36,37,38,39"});
    ASSERT_EQ(pair.with.size(), 8u);
    ASSERT_EQ(pair.without.size(), 8u);
    const auto mask = test::changed(pair.with[0], pair.without[0]);
    EXPECT_GT(area(mask), mask.size() / 20)
        << "hair and its shadows fill a good part of the picture";
    // A gap in the closed mask is scalp, or hair as bright as what it hides: a few percent.
    EXPECT_LT(test::hole_share(mask, pair.with[0].width, 2), 0.06);
    // Still frames of a history that blends a tenth of each frame: a step or two at most.
    EXPECT_LT(test::flicker(pair.with, mask), 3.0);
}

TEST(RealScenes, StillDitherCoversTheSameHeadInASingleFrame) {
    REQUIRE_DATA();
    const Pair moving = draw("sintel", "sintel_bust.glb", "sintel.obj", kSintelHair,
                             {"--size", "480x360", "--frames", "32"});
    const Pair still =
        draw("sintel_still", "sintel_bust.glb", "sintel.obj", kSintelHair,
             {"--size", "480x360", "--frames", "1", "--no-taa", "--set", "opacity=dither_still"});
    ASSERT_EQ(moving.with.size(), 1u);
    ASSERT_EQ(still.with.size(), 1u);
    const auto full = test::changed(moving.with[0], moving.without[0]);
    const auto dithered = test::changed(still.with[0], still.without[0]);
    EXPECT_NEAR(static_cast<double>(area(dithered)) / static_cast<double>(area(full)), 1.0, 0.15);
    // A single dithered frame has gaps of several pixels where her hair covers less than half, at
    // the fringes; a bald crown would be several times that.
    EXPECT_LT(test::bald_share(dithered, still.with[0].width), 0.10);
}

TEST(RealScenes, StraightHairFillsThePicture) {
    REQUIRE_DATA();
    const std::string groom = (kData / "hair/straight.hair").string();
    const auto pictures = test::render(
        "straight", {groom, "--size", "640x360", "--frames", "40", "--save", "36,37,38,39"});
    ASSERT_EQ(pictures.size(), 4u);
    const asset::Image& picture = pictures[0];
    // Sky and ground hardly change along a row, so what differs from the row's end is hair.
    std::vector<uint8_t> mask(size_t{picture.width} * picture.height);
    std::vector<uint8_t> rows(picture.height);
    for (size_t pixel = 0; pixel < mask.size(); ++pixel) {
        const size_t y = pixel / picture.width;
        for (size_t c = 0; c < 3; ++c) {
            const int step =
                std::abs(picture.rgba[pixel * 4 + c] - picture.rgba[y * picture.width * 4 + c]);
            mask[pixel] |= step > 10 ? 1 : 0;
        }
        rows[y] |= mask[pixel];
    }
    EXPECT_GT(std::ranges::count(rows, uint8_t{1}), std::ssize(rows) * 85 / 100);
    EXPECT_EQ(rows.front() | rows.back(), 0) << "whole in the picture, tips too";
    EXPECT_GT(area(mask), mask.size() * 15 / 100);
    EXPECT_LT(test::hole_share(mask, picture.width, 2), 0.06);
    const std::vector<uint8_t> all(size_t{640} * 360, 1);
    EXPECT_LT(test::flicker(pictures, all), 1.5);
}

TEST(RealScenes, HairOnTheHeadJointFollowsAnAnimatedCharacter) {
    REQUIRE_DATA();
    // The mohawk stands 0.2 to 1.1 m above its origin: scaled and moved onto the man's head.
    const nlohmann::json hair = {
        {"groom", (kData / "hair/Ratboy_mohawk.tfx").string()},
        {"upright", true},
        {"transform", {{"translation", {0.0, 0.0, 0.0}}, {"scale", {0.3, 0.3, 0.3}}}},
        {"material", {{"melanin", {{"eumelanin", 0.3}, {"pheomelanin", 0.1}}}}}};
    const Pair pair = draw("man", "CesiumMan.collada2gltf.glb", "Skeleton_neck_joint_2", hair,
                           {"--size", "320x360", "--frames", "31", "--save", "0,10,20,30"});
    ASSERT_EQ(pair.with.size(), 4u);
    // The man walks, so his hair is elsewhere in each picture, and always as large.
    std::vector<double> centres;
    for (size_t frame = 0; frame < pair.with.size(); ++frame) {
        const auto mask = test::changed(pair.with[frame], pair.without[frame]);
        double sum = 0.0;
        for (size_t i = 0; i < mask.size(); ++i) {
            const size_t row = i / pair.with[frame].width;
            sum += mask[i] * static_cast<double>(row);
        }
        ASSERT_GT(area(mask), 100u) << "frame " << frame;
        centres.push_back(sum / static_cast<double>(area(mask)));
    }
    const auto [low, high] = std::ranges::minmax(centres);
    EXPECT_GT(high - low, 0.5) << "the head of a walking man goes up and down";
    EXPECT_LT(high - low, 40.0) << "and never leaves him";
}

/// Column of the mask's centre, in pixels.
double centre_x(const std::vector<uint8_t>& mask, uint32_t width) {
    double sum = 0.0;
    for (size_t i = 0; i < mask.size(); ++i) sum += mask[i] * static_cast<double>(i % width);
    return sum / static_cast<double>(area(mask));
}

TEST(RealScenes, FurStaysOnARunningFox) {
    REQUIRE_DATA();
    const fs::path groom = test::write_fur("fox_fur", kData / "gltf/Fox.glb", "fox", 60'000, 3.0);
    const nlohmann::json hair = {
        {"groom", groom.string()},
        {"upright", false},
        {"binding", {{"mesh", "fox"}}},
        {"width", {{"root", 0.0006}, {"tip_scale", 0.3}}},
        {"material",
         {{"base_color", {0.45, 0.18, 0.05}}, {"color_variation", 0.3}, {"roughness", 0.4}}}};
    // The file is in centimetres.
    const Pair pair = draw("fox", "Fox.glb", "root", hair,
                           {"--size", "480x300", "--frames", "41", "--save", "5,20,30,40"},
                           [](nlohmann::json& scene) {
                               test::scale_scene(scene, 0.01);
                               test::keep_animation(scene, "Run");
                           });
    ASSERT_EQ(pair.with.size(), 4u);
    std::vector<size_t> areas;
    for (size_t frame = 0; frame < pair.with.size(); ++frame) {
        const auto mask = test::changed(pair.with[frame], pair.without[frame]);
        areas.push_back(area(mask));
        // Fur on the ground, or left behind, would not be where the fox's own pixels are.
        const auto fox = test::changed(pair.without[frame], pair.without[(frame + 1) % 4]);
        EXPECT_NEAR(centre_x(mask, 480), centre_x(fox, 480), 40.0) << frame;
    }
    const auto [low, high] = std::ranges::minmax(areas);
    EXPECT_GT(low, 480u * 300u / 20) << "the fox is covered";
    EXPECT_LT(static_cast<double>(high) / static_cast<double>(low), 1.3);
}

TEST(RealScenes, BoundHairFollowsAWalkingMan) {
    REQUIRE_DATA();
    const nlohmann::json hair = {
        {"groom", (kData / "hair/Ratboy_mohawk.tfx").string()},
        {"upright", true},
        {"binding", {{"mesh", "Cesium_Man"}}},
        {"transform", {{"translation", {0.0, 0.0, 0.0}}, {"scale", {0.3, 0.3, 0.3}}}},
        {"material", {{"melanin", {{"eumelanin", 0.3}, {"pheomelanin", 0.1}}}}}};
    const std::vector<std::string> arguments = {"--size", "320x360", "--frames",
                                                "31",     "--save",  "0,10,20,30"};
    const Pair bound =
        draw("man_bound", "CesiumMan.collada2gltf.glb", "Skeleton_neck_joint_2", hair, arguments);
    nlohmann::json loose = hair;
    loose.erase("binding");
    const Pair rigid =
        draw("man_rigid", "CesiumMan.collada2gltf.glb", "Skeleton_neck_joint_2", loose, arguments);
    ASSERT_EQ(bound.with.size(), 4u);
    ASSERT_EQ(rigid.with.size(), 4u);
    for (size_t frame = 0; frame < bound.with.size(); ++frame) {
        // A head hardly bends: bound to its skin or to its joint, hair is in the same place.
        const auto a = test::changed(bound.with[frame], bound.without[frame]);
        const auto b = test::changed(rigid.with[frame], rigid.without[frame]);
        ASSERT_GT(area(a), 100u);
        EXPECT_NEAR(static_cast<double>(area(a)), static_cast<double>(area(b)),
                    0.1 * static_cast<double>(area(b)))
            << frame;
        EXPECT_NEAR(centre_x(a, 320), centre_x(b, 320), 2.0) << frame;
    }
}

}  // namespace
}  // namespace vellus
