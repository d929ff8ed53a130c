#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "game_demo/tools/accuracy/merge.h"
#include "game_demo/tools/accuracy/pictures.h"
#include "game_demo/tools/accuracy/report.h"
#include "tests/support/own_folder.h"

namespace vellus::demo {
namespace {

AccuracyRow row(const std::string& id, const std::string& device = "lavapipe") {
    AccuracyRow result;
    result.id = id;
    result.axis = "shadow";
    result.technique = id;
    result.groom = "fur";
    result.colour = "brown";
    result.light = "back";
    result.device = device;
    return result;
}

AccuracyTable table(std::vector<AccuracyRow> rows, const std::string& device = "lavapipe") {
    AccuracyTable result;
    result.device = result.driver = device;
    result.rows = std::move(rows);
    return result;
}

TEST(AccuracyReport, EscapesWhatWouldBeMarkup) {
    EXPECT_EQ(escape_html("<a href=\"x\" t='y'>&amp;</a>"),
              "&lt;a href=&quot;x&quot; t=&#39;y&#39;&gt;&amp;amp;&lt;/a&gt;");
    EXPECT_EQ(escape_html("90 % ΔV"), "90 % ΔV");
    const std::string json = escape_script(R"({"a": "</script><!--"})");
    EXPECT_EQ(json.find('<'), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(json).at("a"), "</script><!--") << "still the same JSON";
}

TEST(AccuracyReport, APageThatNamesOfFilesCannotBreak) {
    auto all = table({row("none")}, "</title><script>alert(1)</script>");
    all.command = "vellus_accuracy </script>";
    const std::string page = to_html(all, "/no/such/folder");
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    const auto count = [&](const std::string& what) {
        size_t found = 0;
        for (size_t at = 0; (at = page.find(what, at)) != std::string::npos; ++at) ++found;
        return found;
    };
    EXPECT_EQ(count("</script>"), 2u) << "data and program";
    EXPECT_EQ(count("http://") + count("https://"), 1u) << "the name of SVG alone";
    EXPECT_EQ(page.find("@data@"), std::string::npos);
}

TEST(AccuracyReport, PicturesAreInThePage) {
    const test::OwnFolder folder("accuracy_report");
    asset::Image image{2, 2, std::vector<uint8_t>(16, 200)};
    ASSERT_TRUE(asset::save_png(folder.path() / "jobs" / "a.png", image));
    AccuracyRow with = row("none");
    with.pictures = {"jobs/a.png", "jobs/missing.png", ""};
    const std::string page = to_html(table({with}), folder.path());
    EXPECT_NE(page.find("data:image/jpeg;base64,/9j/"), std::string::npos);
}

TEST(AccuracyReport, CsvHasALinePerRowAndQuotesCommas) {
    AccuracyRow odd = row("none");
    odd.device = "llvmpipe (LLVM 15.0.6, 256 bits)";
    odd.measures = {{"flip", 0.5}};
    const std::string csv = to_csv(table({odd, row("other")}));
    EXPECT_EQ(std::ranges::count(csv, '\n'), 3);
    EXPECT_NE(csv.find("\"llvmpipe (LLVM 15.0.6, 256 bits)\""), std::string::npos);
    EXPECT_NE(csv.find(",flip,"), std::string::npos);
}

TEST(AccuracyMerge, JoinsRowsOnceAndNamesEveryDevice) {
    const AccuracyTable all =
        join({table({row("b"), row("a")}), table({row("a")}), table({row("a", "gpu")}, "gpu")});
    ASSERT_EQ(all.rows.size(), 3u);
    EXPECT_EQ(all.rows[0].id, "a");
    EXPECT_EQ(all.rows[0].device, "gpu");
    EXPECT_EQ(all.rows[1].device, "lavapipe");
    EXPECT_EQ(all.rows[2].id, "b");
    EXPECT_EQ(all.device, "lavapipe, gpu");
}

TEST(AccuracyMerge, PartsBecomeTheWholeFolder) {
    const test::OwnFolder folder("accuracy_merge");
    for (const char* part : {"one", "two"}) {
        const auto out = folder.path() / part;
        ASSERT_TRUE(write_file(out / "jobs" / (std::string(part) + ".json"), std::string_view("")));
        ASSERT_TRUE(write_reports(out, table({row(part)})));
    }
    AccuracyOptions options;
    options.merge = {folder.path() / "one", folder.path() / "two"};
    options.out = folder.path() / "all";
    const auto merged = merge(options);
    ASSERT_TRUE(merged) << merged.error().message();
    EXPECT_TRUE(std::filesystem::exists(options.out / "jobs" / "two.json"));
    EXPECT_TRUE(std::filesystem::exists(options.out / "accuracy.html"));
    const auto read = load_accuracy(options.out / "accuracy.json");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->rows.size(), 2u);
    const auto frames = load_accuracy(options.out / "frames.json");
    ASSERT_TRUE(frames);
    EXPECT_TRUE(frames->rows.empty()) << "there was no whole frame";
    options.merge.push_back(folder.path() / "three");
    const auto missing = merge(options);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message().find("three"), std::string::npos);
}

TEST(AccuracyPictures, JpegReadsBackAndHeatGoesFromBlackToYellow) {
    const std::vector<float> errors = {0.0f, 0.5f, 1.0f, 2.0f};
    const asset::Image heat = heat_map(errors, {4, 1});
    EXPECT_LT(heat.rgba[0] + heat.rgba[1] + heat.rgba[2], 10);
    EXPECT_GT(heat.rgba[8] + heat.rgba[9] + heat.rgba[10], 600);
    EXPECT_EQ(heat.rgba[8], heat.rgba[12]) << "beyond 1 as 1";
    asset::Image grey{16, 16, std::vector<uint8_t>(size_t{4} * 256, 100)};
    const auto jpeg = encode_jpeg(grey);
    ASSERT_TRUE(jpeg);
    const auto back = asset::decode_image(*jpeg);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->rgba[0], 100, 3);
}

}  // namespace
}  // namespace vellus::demo
