#include <gtest/gtest.h>

#include "engine/platform/files.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/groom/upright.h"
#include "tests/unit/hair/groom/sample_groom.h"

namespace vellus::hair {
namespace {

constexpr const char* kStraight = "straight.hair";
constexpr const char* kSintel = "SintelHairOriginal.16points.tfx";
constexpr const char* kRatboy = "Ratboy_mohawk.tfx";

/// Skips the test where the real grooms are not at hand.
#define REQUIRE_GROOM(name)                                                \
    if (!std::filesystem::exists(test::data_file(name))) {                 \
        GTEST_SKIP() << test::data_file(name).string() << " is not there"; \
    }                                                                      \
    static_assert(true)

LoadedGroom load(const char* name) {
    auto loaded = load_groom(test::data_file(name));
    EXPECT_TRUE(loaded) << loaded.error().message();
    return std::move(*loaded);
}

/// A fresh folder for files that a test writes.
std::filesystem::path scratch(const char* name) {
    auto folder = std::filesystem::temp_directory_path() / "vellus_grooms" / name;
    std::filesystem::remove_all(folder);
    return folder;
}

TEST(RealGrooms, StraightHairIsWhatItsReadmeSays) {
    REQUIRE_GROOM(kStraight);
    const LoadedGroom loaded = load(kStraight);
    EXPECT_EQ(loaded.report.strands, 10000u);
    EXPECT_EQ(loaded.report.points, 160000u);
    EXPECT_EQ(loaded.report.segments, 150000u);
    EXPECT_EQ(loaded.report.min_points, 16u);
    EXPECT_EQ(loaded.report.max_points, 16u);
    EXPECT_TRUE(loaded.report.clean()) << to_text(loaded.report);
    // Lengths and box computed by a separate script from the file's bytes.
    EXPECT_NEAR(loaded.report.min_length, 55.291417688, 1e-6);
    EXPECT_NEAR(loaded.report.mean_length, 78.153463423, 1e-6);
    EXPECT_NEAR(loaded.report.max_length, 107.011476117, 1e-6);
    EXPECT_NEAR(loaded.report.bounds.low.z, -22.7085533, 1e-6);
    EXPECT_NEAR(loaded.report.bounds.high.z, 63.6779594, 1e-6);
    EXPECT_EQ(loaded.groom.default_thickness, 0.1f);
    EXPECT_EQ(loaded.groom.colors.size(), 160000u);
    EXPECT_NE(loaded.groom.info.find("Cem Yuksel"), std::string::npos);
}

TEST(RealGrooms, StraightHairStandsUprightAtHumanSize) {
    REQUIRE_GROOM(kStraight);
    const LoadedGroom loaded = load(kStraight);
    const Upright upright = upright_transform(loaded.groom);
    // File: up is +Z; the face is at +Y, where no root lies below z = 48.
    const glm::dmat3 turn = glm::dmat3(upright.to_metres);
    EXPECT_GT((turn * glm::dvec3(0, 0, 1)).y, 0.0) << upright.reason;
    EXPECT_GT((turn * glm::dvec3(0, 1, 0)).z, 0.0) << upright.reason;
    const glm::dvec3 size = upright.high - upright.low;
    EXPECT_GT(size.y, 0.25);
    EXPECT_LT(size.y, 0.5);
    EXPECT_GT(upright.scalp_low.y, upright.low.y + 0.15);
    const double width = default_width(loaded.groom, upright.metres_per_unit);
    EXPECT_NEAR(width, 0.1 * upright.metres_per_unit, 1e-9);
    EXPECT_GT(width, 1e-4);
    EXPECT_LT(width, 1e-3);
}

TEST(RealGrooms, SintelIsInMetresWithoutUvs) {
    REQUIRE_GROOM(kSintel);
    const LoadedGroom loaded = load(kSintel);
    EXPECT_EQ(loaded.report.strands, 11400u);
    EXPECT_EQ(loaded.report.points, 11400u * 16);
    EXPECT_NEAR(loaded.report.mean_length, 0.10314027, 1e-7);
    EXPECT_EQ(loaded.report.non_finite_strands, 0u);
    EXPECT_TRUE(loaded.groom.strand_uvs.empty());
    EXPECT_EQ(upright_transform(loaded.groom).to_metres, glm::dmat4(1.0));
    const double width = default_width(loaded.groom, 1.0);
    EXPECT_GT(width, 1e-4);
    EXPECT_LT(width, 1e-3);
}

TEST(RealGrooms, RatboyHasUvsAndTinySegments) {
    REQUIRE_GROOM(kRatboy);
    const LoadedGroom loaded = load(kRatboy);
    // Of the 124 segments below 1e-5 those of collapsed strands are gone with their strands.
    EXPECT_EQ(loaded.report.strands + loaded.report.collapsed_strands, 2228u);
    EXPECT_EQ(loaded.report.max_points, 32u);
    EXPECT_EQ(loaded.groom.strand_uvs.size(), loaded.report.strands);
    EXPECT_EQ(loaded.report.zero_segments + loaded.report.tiny_segments +
                  31 * loaded.report.collapsed_strands,
              124u)
        << to_text(loaded.report);
    EXPECT_EQ(upright_transform(loaded.groom).to_metres, glm::dmat4(1.0));
}

TEST(RealGrooms, FilesAreRewrittenWithTheSameNumbers) {
    for (const char* name : {kStraight, kSintel, kRatboy}) {
        REQUIRE_GROOM(name);
        const LoadedGroom first = load(name);
        const auto path = scratch("same") / name;
        const auto saved = save_groom(first.groom, path);
        ASSERT_TRUE(saved) << saved.error().message();
        const auto again = load_groom(path);
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_EQ(again->groom.points, first.groom.points);
        EXPECT_EQ(again->groom.strand_begin, first.groom.strand_begin);
        EXPECT_EQ(again->groom.thickness, first.groom.thickness);
        EXPECT_EQ(again->groom.colors, first.groom.colors);
        EXPECT_EQ(again->groom.strand_uvs, first.groom.strand_uvs);
        EXPECT_EQ(again->groom.inverse_mass, first.groom.inverse_mass);
        // Byte for byte, but for what the repair dropped.
        if (first.report.clean()) {
            EXPECT_EQ(*read_file(path), *read_file(test::data_file(name)));
        }
    }
}

TEST(RealGrooms, PreparedStrandsKeepEverySegmentThatHasALength) {
    for (const char* name : {kStraight, kSintel, kRatboy}) {
        REQUIRE_GROOM(name);
        const LoadedGroom loaded = load(name);
        const Upright upright = upright_transform(loaded.groom);
        const StrandData data = prepare_strands(loaded.groom, upright.to_metres, 1e-4f);
        EXPECT_EQ(data.strand_count(), loaded.report.strands);
        EXPECT_EQ(data.segment_count() + data.skipped_segments, loaded.report.segments);
        EXPECT_EQ(data.skipped_segments, loaded.report.zero_segments) << name;
        EXPECT_TRUE(data.point_color.empty());
    }
}

TEST(LoadGroom, ErrorsNameTheFileAndWhatItShouldBe) {
    const auto folder = scratch("errors");
    EXPECT_NE(load_groom(folder / "none.hair").error().message().find("none.hair"),
              std::string::npos);
    ASSERT_TRUE(write_file(folder / "text.hair", std::string_view("not a groom")));
    const std::string message = load_groom(folder / "text.hair").error().message();
    EXPECT_NE(message.find("is no groom"), std::string::npos) << message;
    ASSERT_TRUE(write_file(folder / "empty.tfx", std::string_view()));
    EXPECT_FALSE(load_groom(folder / "empty.tfx"));
    EXPECT_NE(save_groom(Groom{}, folder / "a.abc").error().message().find(".abc"),
              std::string::npos);
}

TEST(LoadGroom, ContentDecidesNotTheName) {
    const auto folder = scratch("content");
    const Groom groom = test::random_groom({4, 4, 4});
    ASSERT_TRUE(write_file(folder / "really.tfx", *write_hair(groom)));
    ASSERT_TRUE(write_file(folder / "really.hair", *write_tfx(groom)));
    EXPECT_EQ(load_groom(folder / "really.tfx")->groom.format, GroomFormat::kHair);
    EXPECT_EQ(load_groom(folder / "really.hair")->groom.format, GroomFormat::kTfx4);
}

TEST(LoadGroom, LineStripsAreWrittenAndReadBackBitForBit) {
    Groom groom = test::random_groom({4, 2, 9});
    groom.format = GroomFormat::kGltf;
    for (size_t p = 0; p < groom.points.size(); ++p) {
        groom.thickness.push_back(test::fraction(p));
        groom.colors.emplace_back(test::fraction(p), test::fraction(p + 1), 0.0f,
                                  test::fraction(p + 2));
    }
    groom.strand_uvs = {{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}};
    groom.default_color = {0.1f, 0.2f, 0.3f};
    groom.has_default_color = true;
    const auto path = scratch("gltf") / "a.glb";
    ASSERT_TRUE(save_groom(groom, path));
    const auto again = load_groom(path);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->groom.format, GroomFormat::kGltf);
    EXPECT_EQ(again->groom.points, groom.points);
    EXPECT_EQ(again->groom.strand_begin, groom.strand_begin);
    EXPECT_EQ(again->groom.thickness, groom.thickness);
    EXPECT_EQ(again->groom.colors, groom.colors);
    EXPECT_EQ(again->groom.strand_uvs, groom.strand_uvs);
    EXPECT_EQ(again->groom.default_color, groom.default_color);
}

TEST(RealGrooms, GroomsSurviveTheWayThroughGltf) {
    for (const char* name : {kStraight, kSintel, kRatboy}) {
        REQUIRE_GROOM(name);
        const LoadedGroom first = load(name);
        const auto path = scratch("convert") / "a.glb";
        ASSERT_TRUE(save_groom(first.groom, path));
        const auto again = load_groom(path);
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_EQ(again->groom.points, first.groom.points) << name;
        EXPECT_EQ(again->groom.strand_begin, first.groom.strand_begin);
        EXPECT_EQ(again->groom.strand_uvs, first.groom.strand_uvs);
        EXPECT_EQ(thickness_at(again->groom, 1, 20), thickness_at(first.groom, 1, 20));
    }
}

}  // namespace
}  // namespace vellus::hair
