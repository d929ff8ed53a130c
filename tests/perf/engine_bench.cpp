#include <fmt/format.h>

#include <memory>

#include "engine/platform/files.h"
#include "tests/perf/bench.h"
#include "tests/perf/engine_rows.h"
#include "tests/perf/frame_samples.h"

namespace vellus::bench {

namespace {

struct Options : EngineOptions {
    std::string json;
};

Result<void> run(const Options& options) {
    Report report{.device = "none",
                  .command = fmt::format("vellus_bench engine --rounds {}", options.rounds)};
    std::vector<double> calibrations;
    if (auto done = measure_engine(options, report, calibrations); !done) return done;
    if (report.rows.empty()) {
        return Error{"is in no row's name", options.only, "run without --only to see them"};
    }
    report.calibration = make_row("calibration", "ms", calibrations);
    print_calibration(report);
    if (options.json.empty()) return {};
    return write_file(options.json, std::string_view(to_json(report)));
}

const Registration kEngine(
    {"engine", "ECS, frame graph, asset loading and groom generation, without a device",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         app.add_option("--only", options->only, "rows whose name has this");
         app.add_option("--rounds", options->rounds, "counted rounds of each")
             ->check(CLI::Range(1, 100000))
             ->capture_default_str();
         app.add_option("--json", options->json, "file for the report; see compare");
         auto* const inject =
             app.add_option("--inject", options->inject_ms,
                            "milliseconds to waste in every round, to see compare catch it")
                 ->check(CLI::Range(0.0, 1e4));
         app.add_option("--inject-into", options->inject_into, "only in rows whose name has this")
             ->needs(inject);
         return [options] { return exit_status(run(*options)); };
     }});

}  // namespace

}  // namespace vellus::bench
