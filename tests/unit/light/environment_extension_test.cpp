#include "modules/light/environment_extension.h"

#include <gtest/gtest.h>

namespace vellus::light {
namespace {

constexpr const char* kWhere = "scene.gltf, scene 0, VELLUS_environment";

TEST(EnvironmentExtension, FieldsArriveAndAbsentOnesKeepTheirDefault) {
    const auto all = parse_environment_extension(
        R"({"image": "sky.exr", "intensity": 2.5, "rotation": -1.5, "exposure": 3})", kWhere);
    ASSERT_TRUE(all) << all.error().message();
    EXPECT_EQ(all->image, "sky.exr");
    EXPECT_EQ(all->intensity, 2.5f);
    EXPECT_EQ(all->rotation, -1.5f);
    EXPECT_EQ(all->exposure, 3.0f);
    const auto few = parse_environment_extension(R"({"image": "sky.hdr"})", kWhere);
    ASSERT_TRUE(few);
    EXPECT_EQ(few->intensity, 1.0f);
    EXPECT_EQ(few->rotation, 0.0f);
}

TEST(EnvironmentExtension, ErrorsNameFileFieldAndRange) {
    const auto message = [](const char* json) {
        const auto parsed = parse_environment_extension(json, kWhere);
        return parsed ? std::string() : parsed.error().message();
    };
    EXPECT_NE(message("{}").find("VELLUS_environment.image"), std::string::npos);
    const std::string negative = message(R"({"image": "a", "intensity": -1})");
    EXPECT_NE(negative.find("scene.gltf"), std::string::npos);
    EXPECT_NE(negative.find("intensity: is -1 (give a number from 0 to 1000000)"),
              std::string::npos)
        << negative;
    EXPECT_NE(message(R"({"image": "a", "exposure": "x"})").find("string"), std::string::npos);
}

TEST(EnvironmentExtension, UnknownFieldsAreWarnedOf) {
    const auto parsed = parse_environment_extension(R"({"image": "a", "gain": 1})", kWhere);
    ASSERT_TRUE(parsed);
    ASSERT_EQ(parsed->warnings.size(), 1u);
    EXPECT_NE(parsed->warnings[0].find("gain"), std::string::npos);
}

}  // namespace
}  // namespace vellus::light
