#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "engine/platform/hash.h"
#include "game_demo/src/app.h"
#include "tests/end_to_end/demo_process.h"
#include "tests/end_to_end/small_groom.h"
#include "tests/support/own_folder.h"

namespace vellus::demo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class HeadlessTest : public testing::Test {
  protected:
    void SetUp() override {
        ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
        groom_ = test::write_small_groom(folder_);
        out_ = folder_ / "out";
    }

    /// A run of the program, small unless `more` says otherwise.
    test::Ended run(std::vector<std::string> more) {
        std::vector<std::string> arguments = {groom_,     "--headless", "--out",
                                              out_,       "--size",     "96x64",
                                              "--frames", "4",          "--validation"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::run(test::demo(arguments));
    }
    json stats() {
        std::ifstream file(out_ / "stats.json");
        return json::parse(file, nullptr, false);
    }
    std::vector<std::string> files(const fs::path& folder) {
        std::vector<std::string> names;
        if (!fs::exists(folder)) return names;
        for (const auto& entry : fs::directory_iterator(folder)) {
            names.push_back(entry.path().filename());
        }
        std::ranges::sort(names);
        return names;
    }

    test::OwnFolder own_folder_{"headless"};
    fs::path folder_ = own_folder_.path();
    fs::path groom_;
    fs::path out_;
};

using Names = std::vector<std::string>;

TEST_F(HeadlessTest, WritesThePicturesAndTheStatsOfTheContract) {
    const auto ended = run({"--save", "all", "--seed", "7"});
    ASSERT_EQ(ended.status, 0) << ended.output;
    EXPECT_EQ(files(out_), (Names{"frame_0000.png", "frame_0001.png", "frame_0002.png",
                                  "frame_0003.png", "stats.json"}));
    const json run_stats = stats();
    EXPECT_EQ(run_stats["version"], 1);
    for (const char* field : {"name", "driver", "api"}) {
        EXPECT_FALSE(run_stats["device"][field].get<std::string>().empty()) << field;
    }
    EXPECT_EQ(run_stats["scene"], groom_.string());
    EXPECT_EQ(run_stats["seed"], 7);
    EXPECT_EQ(run_stats["size"], (json{96, 64}));
    const auto image = asset::load_image(out_ / "frame_0003.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 96u);
    EXPECT_EQ(image->height, 64u);
    const uint64_t hash = fnv1a(std::as_bytes(std::span(image->rgba)));
    EXPECT_EQ(run_stats["hash"], fmt::format("{:016x}", hash));

    ASSERT_EQ(run_stats["frames"].size(), 4u);
    for (size_t index = 0; index < 4; ++index) {
        const json& frame = run_stats["frames"][index];
        EXPECT_EQ(frame["index"], index);
        EXPECT_GT(frame["cpu_ms"], 0.0);
        double passes_ms = 0.0;
        for (const json& pass : frame["passes"]) {
            passes_ms += pass["gpu_ms"].get<double>() + pass["cpu_ms"].get<double>();
            EXPECT_GE(pass["draws"].get<int>() + pass["dispatches"].get<int>(), 0);
        }
        EXPECT_NEAR(frame["unattributed_ms"].get<double>(),
                    frame["wall_ms"].get<double>() - passes_ms, 1e-9);
        EXPECT_GE(frame["memory"]["transient_unaliased_bytes"], frame["memory"]["transient_bytes"]);
        EXPECT_GT(frame["memory"]["persistent_bytes"], 0);
        ASSERT_EQ(frame["effects"].size(), 5u) << "one groom, five axes";
        EXPECT_EQ(frame["effects"][0]["axis"], "opacity");
        EXPECT_FALSE(frame["effects"][0]["reason"].get<std::string>().empty());
    }
}

TEST_F(HeadlessTest, SameSeedSamePicture) {
    ASSERT_EQ(run({"--seed", "3"}).status, 0);
    const std::string hash = stats()["hash"];
    ASSERT_EQ(run({"--seed", "3"}).status, 0) << "an existing folder is no obstacle";
    EXPECT_EQ(stats()["hash"], hash) << "in a second process";

    Options options;
    options.scene = groom_;
    options.headless = true;
    options.frames = 4;
    options.size = {96, 64};
    options.out = out_;
    options.seed = 3;
    for (int time = 0; time < 2; ++time) {
        ASSERT_EQ(demo::run(options), 0);
        EXPECT_EQ(stats()["hash"], hash) << "twice in a row in one process";
    }
    ASSERT_EQ(run({"--seed", "4"}).status, 0);
    EXPECT_NE(stats()["hash"], hash) << "the seed moves the dither pattern";
}

TEST_F(HeadlessTest, GraphSwitchesDoNotChangeThePicture) {
    ASSERT_EQ(run({}).status, 0);
    const std::string hash = stats()["hash"];
    for (const char* name :
         {"no_culling", "no_aliasing", "full_barriers", "random_order=11", "poison", "immediate"}) {
        const auto ended = run({"--graph-switch", name});
        ASSERT_EQ(ended.status, 0) << ended.output;
        EXPECT_EQ(stats()["hash"], hash) << name;
    }
}

TEST_F(HeadlessTest, SavesTheFramesAskedForAndCountsNoWarmup) {
    const auto ended = run({"--save", "0,2", "--warmup", "3"});
    ASSERT_EQ(ended.status, 0) << ended.output;
    EXPECT_EQ(files(out_), (Names{"frame_0000.png", "frame_0002.png", "stats.json"}));
    EXPECT_EQ(stats()["frames"].size(), 4u);
    fs::remove_all(out_);
    ASSERT_EQ(run({}).status, 0);
    EXPECT_EQ(files(out_), (Names{"frame_0003.png", "stats.json"}));
}

TEST_F(HeadlessTest, WarmupFramesAreFramesThatAreNotCounted) {
    ASSERT_EQ(run({"--frames", "6"}).status, 0);
    const std::string hash = stats()["hash"];
    ASSERT_EQ(run({"--frames", "2", "--warmup", "4"}).status, 0);
    EXPECT_EQ(stats()["hash"], hash);
}

TEST_F(HeadlessTest, SmallAndOddSizesWork) {
    for (const char* size : {"1x1", "37x23", "1x50"}) {
        const auto ended = run({"--size", size});
        EXPECT_EQ(ended.status, 0) << size << ": " << ended.output;
    }
}

TEST_F(HeadlessTest, TechniquesAreSetAndExplained) {
    const auto ended = run({"--set", "shadow=none", "--set", "environment=none", "--explain"});
    ASSERT_EQ(ended.status, 0) << ended.output;
    EXPECT_NE(ended.output.find("shadow=none"), std::string::npos);
    EXPECT_NE(ended.output.find("frame graph"), std::string::npos);
    const json last = stats()["frames"][3];
    const auto technique = [&](const char* axis) -> std::string {
        for (const json& row : last["effects"]) {
            if (row["axis"] == axis) return row["technique"];
        }
        return "";
    };
    EXPECT_EQ(technique("shadow"), "none");
    EXPECT_EQ(technique("environment"), "none");
    EXPECT_EQ(technique("opacity"), "dither");
    for (const json& pass : last["passes"]) {
        EXPECT_EQ(pass["name"].get<std::string>().find("hair/shadow"), std::string::npos)
            << "shadows that are off cost no pass";
    }
}

TEST_F(HeadlessTest, MistakesEndWithStatusTwoAndOneLine) {
    const auto ended = run({"--set", "shadow=magic"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(std::ranges::count(ended.output, '\n'), 1) << ended.output;
    EXPECT_NE(ended.output.find("pcf_exponential"), std::string::npos);
    EXPECT_FALSE(fs::exists(out_));
}

TEST_F(HeadlessTest, FailuresNameTheirCauseAndLeaveNothingHalfDone) {
    // A folder that cannot be made: its parent is a file.
    const auto blocked = test::run(
        test::demo({groom_, "--headless", "--out", (groom_ / "out").string(), "--frames", "2"}));
    EXPECT_EQ(blocked.status, 1);
    EXPECT_NE(blocked.output.find("small.tfx"), std::string::npos) << blocked.output;

    // A scene that is not there, after a run that went well: no stale figures.
    ASSERT_EQ(run({}).status, 0);
    const auto missing = test::run(test::demo({"no_such.gltf", "--headless", "--out", out_}));
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.output.find("no_such.gltf"), std::string::npos) << missing.output;
    EXPECT_EQ(files(out_), (Names{"frame_0003.png"}));
    EXPECT_EQ(files(folder_), (Names{"cache", "out", "small.tfx"}));
}

TEST_F(HeadlessTest, AnUnknownDeviceListsTheKnownOnes) {
    const auto listed = test::run(test::demo({"--list-devices"}));
    ASSERT_EQ(listed.status, 0) << listed.output;
    const std::string first = listed.output.substr(0, listed.output.find('\n'));
    ASSERT_FALSE(first.empty());
    const auto ended = run({"--device", "no such device"});
    EXPECT_EQ(ended.status, 1);
    EXPECT_NE(ended.output.find(first), std::string::npos) << ended.output;
    EXPECT_EQ(run({"--device", first}).status, 0);
}

}  // namespace
}  // namespace vellus::demo
