#include "assets/generator/asset_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <span>

#include "assets/generator/bust.h"
#include "engine/platform/files.h"
#include "modules/hair/groom/groom_file.h"

namespace vellus::sculpt {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(VELLUS_SOURCE_DIR) / "assets";

TEST(AssetFiles, CommittedFilesAreWhatTheGeneratorWrites) {
    const auto files = make_asset_files();
    ASSERT_TRUE(files) << files.error().message();
    for (const AssetFile& file : *files) {
        const auto committed = read_file(kAssets / file.path);
        ASSERT_TRUE(committed) << committed.error().message();
        EXPECT_TRUE(*committed == file.bytes)
            << file.path << " differs: run build/bin/vellus_make_assets and commit what it writes";
    }
}

TEST(AssetFiles, NoHairIsMoreThanAMillimetreInsideTheBody) {
    for (const char* name : {"grooms/long.hair", "grooms/brows.hair"}) {
        const auto bytes = read_file(kAssets / name);
        ASSERT_TRUE(bytes) << bytes.error().message();
        auto groom = hair::read_hair(*bytes, name);
        ASSERT_TRUE(groom) << groom.error().message();
        const hair::GroomReport report = hair::repair(*groom);
        EXPECT_TRUE(report.clean()) << to_text(report);
        double deepest = 1.0;
        for (const glm::vec3 p : groom->points) {
            deepest = std::min(deepest, bust_distance(glm::dvec3(p.x, p.z, -p.y) * 0.01));
        }
        EXPECT_GT(deepest, -0.001) << name;
    }
}

}  // namespace
}  // namespace vellus::sculpt
