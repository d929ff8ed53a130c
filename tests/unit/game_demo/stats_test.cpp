#include "game_demo/src/stats.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace vellus::demo {
namespace {

RunStats example() {
    FrameStats frame;
    frame.index = 3;
    frame.cpu_ms = 20.0;
    frame.wall_ms = 12.0;
    frame.report.gpu_ms = 8.5;
    frame.report.passes = {{"a/one", 5.0, 0.25, 1, 0}, {"b/two", 3.0, 0.75, 0, 2}};
    frame.report.memory = {100, 150, 7};
    frame.effects = {{"groom \"x\".hair", "shadow", "none", "no light"}};
    RunStats run;
    run.device.name = "device";
    run.device.driver = "driver 1";
    run.device.api = "1.3.2";
    run.scene = "a scene.gltf";
    run.seed = 18446744073709551615u;
    run.size = {64, 48};
    run.hash = 0xab;
    run.frames = {frame};
    return run;
}

TEST(Stats, JsonHasTheContractsFieldsAndNoOthers) {
    const auto json = nlohmann::json::parse(to_json(example()));
    const auto expected = nlohmann::json::parse(R"({
        "version": 1, "device": {"name": "device", "driver": "driver 1", "api": "1.3.2"},
        "scene": "a scene.gltf", "seed": 18446744073709551615, "size": [64, 48],
        "hash": "00000000000000ab",
        "frames": [{"index": 3, "cpu_ms": 20.0, "wall_ms": 12.0, "gpu_ms": 8.5,
            "unattributed_ms": 3.0,
            "passes": [{"name": "a/one", "gpu_ms": 5.0, "cpu_ms": 0.25, "draws": 1, "dispatches": 0},
                       {"name": "b/two", "gpu_ms": 3.0, "cpu_ms": 0.75, "draws": 0, "dispatches": 2}],
            "memory": {"transient_bytes": 100, "transient_unaliased_bytes": 150, "persistent_bytes": 7},
            "effects": [{"groom": "groom \"x\".hair", "axis": "shadow", "technique": "none",
                         "reason": "no light"}]}]})");
    EXPECT_EQ(json, expected) << json.dump(1);
}

TEST(Stats, NamesThatAreNotUtf8StillGiveJson) {
    RunStats run = example();
    run.scene = "broken \xff name";
    EXPECT_TRUE(nlohmann::json::accept(to_json(run)));
}

}  // namespace
}  // namespace vellus::demo
