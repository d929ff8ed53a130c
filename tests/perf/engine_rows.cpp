#include "tests/perf/engine_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "tests/perf/engine_cases.h"

namespace vellus::bench {

namespace {

constexpr uint32_t kWarmUp = 2;
constexpr uint32_t kRoundsPerCalibration = 8;

std::vector<EngineCaseMaker> all_cases() {
    std::vector<EngineCaseMaker> all = entity_cases();
    std::ranges::move(frame_graph_cases(), std::back_inserter(all));
    std::ranges::move(asset_cases(), std::back_inserter(all));
    std::ranges::move(groom_cases(), std::back_inserter(all));
    return all;
}

Result<void> measure(const EngineCaseMaker& maker, uint32_t rounds, Report& report,
                     std::vector<double>& calibrations) {
    const auto made = maker.make();
    if (!made) return made.error();
    std::vector<double> times;
    for (uint32_t round = 0; round < kWarmUp + rounds; ++round) {
        if (round % kRoundsPerCalibration == 0) calibrations.push_back(run_calibration());
        const Timed timed = made->round();
        if (!timed.verified) return Error{"has a wrong result", maker.name, "see its case"};
        if (round >= kWarmUp) times.push_back(1e3 * timed.seconds);
    }
    const Row& row = report.rows.emplace_back(make_row(maker.name, "ms", times));
    fmt::print("{:<48} {:>8.3f} ms (p95 {:.3f})\n", row.name, row.median, row.p95);
    std::fflush(stdout);
    if (made->bytes) {
        report.rows.push_back(make_row(maker.name + "/memory", "bytes", {made->bytes()}));
    }
    return {};
}

}  // namespace

Result<void> measure_engine(const EngineOptions& options, Report& report,
                            std::vector<double>& calibrations) {
    for (const EngineCaseMaker& maker : all_cases()) {
        if (maker.name.find(options.only) == std::string::npos) continue;
        const bool inject = maker.name.find(options.inject_into) != std::string::npos;
        injected_ms() = inject ? options.inject_ms : 0.0;
        auto done = measure(maker, options.rounds, report, calibrations);
        injected_ms() = 0.0;
        if (!done) return done;
    }
    return {};
}

}  // namespace vellus::bench
