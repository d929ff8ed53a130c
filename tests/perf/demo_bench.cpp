#include <fmt/format.h>

#include <memory>

#include "engine/platform/files.h"
#include "tests/perf/bench.h"
#include "tests/perf/engine_rows.h"
#include "tests/perf/frame_samples.h"
#include "tests/perf/scene_rows.h"

// Named scenes for a fixed number of frames: what a frame and each of its passes take, how many
// frames a second that makes, and what the last picture hashes to.
namespace vellus::bench {

namespace {

struct Options : SceneOptions {
    std::string json;
};

/// `engine`: its rows come first.
Result<void> run(const Options& options, const EngineOptions* engine) {
    Report report;
    std::vector<double> calibrations;
    if (engine) {
        if (auto done = measure_engine(*engine, report, calibrations); !done) return done;
    }
    if (auto done = measure_scenes(options, report, calibrations); !done) return done;
    report.calibration = make_row("calibration", "ms", calibrations);
    report.command = fmt::format("vellus_bench {} --size {} {} --frames {} --warm-up {}",
                                 engine ? "all" : "demo", options.size[0], options.size[1],
                                 options.frames, options.warm_up);
    print_calibration(report);
    if (options.json.empty()) return {};
    return write_file(options.json, std::string_view(to_json(report)));
}

void add_common_options(CLI::App& app, Options& options) {
    app.add_option("--size", options.size, "width and height")
        ->expected(2)
        ->check(CLI::Range(1, 16384));
    app.add_option("--frames", options.frames, "counted frames")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--warm-up", options.warm_up, "frames before them")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    app.add_option("--device", options.device, "part of its name");
    app.add_option("--json", options.json, "file for the report; see compare");
}

const Registration kDemo(
    {"demo", "frames per second and per-pass times of the demo's scenes",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         app.add_option("scenes", options->scenes, "names (walk) or files; all that came along");
         add_common_options(app, *options);
         app.add_option("--csv", options->csv, "folder for a line per frame, SCENE.csv");
         app.add_option("--inject", options->inject_ms,
                        "milliseconds to waste in every frame, to see compare catch it")
             ->check(CLI::Range(0.0, 1e4));
         return [options] { return exit_status(run(*options, nullptr)); };
     }});

const Registration kAll({"all", "the rows of engine and of demo's scenes in one report",
                         [](CLI::App& app) -> std::function<int()> {
                             auto options = std::make_shared<Options>();
                             add_common_options(app, *options);
                             return [options] {
                                 const EngineOptions engine;
                                 return exit_status(run(*options, &engine));
                             };
                         }});

}  // namespace

}  // namespace vellus::bench
