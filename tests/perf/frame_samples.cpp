#include "tests/perf/frame_samples.h"

#include <fmt/format.h>

#include <algorithm>

namespace vellus::bench {

void FrameSamples::add(double wall, double cpu, const graph::FrameReport& frame) {
    wall_ms.push_back(wall);
    cpu_ms.push_back(cpu);
    gpu_ms.push_back(frame.gpu_ms);
    for (auto& [name, times] : passes) times.push_back(0.0);
    for (const auto& pass : frame.passes) {
        auto found = std::ranges::find(passes, pass.name, [](const auto& p) { return p.first; });
        if (found == passes.end()) {
            passes.emplace_back(pass.name, std::vector<double>(wall_ms.size(), 0.0));
            found = passes.end() - 1;
        }
        found->second.back() += pass.gpu_ms;
    }
    bytes = static_cast<double>(frame.memory.transient_bytes + frame.memory.persistent_bytes);
}

void add_rows(Report& report, const std::string& name, const FrameSamples& samples) {
    report.rows.push_back(make_row(name + "/wall", "ms", samples.wall_ms));
    report.rows.push_back(make_row(name + "/cpu", "ms", samples.cpu_ms));
    for (const auto& [pass, times] : samples.passes) {
        report.rows.push_back(make_row(fmt::format("{}/{}", name, pass), "ms", times));
    }
    report.rows.push_back(make_row(name + "/memory", "bytes", {samples.bytes}));
}

void print_passes(const FrameSamples& samples, double least_ms) {
    std::vector<Row> rows;
    rows.reserve(samples.passes.size());
    for (const auto& [name, times] : samples.passes) rows.push_back(make_row(name, "ms", times));
    std::ranges::sort(rows, std::greater{}, &Row::median);
    for (const Row& row : rows) {
        if (row.median < least_ms) break;
        fmt::print("    {:<26} {:>8.2f} ms (p95 {:.2f})\n", row.name, row.median, row.p95);
    }
}

void print_calibration(const Report& report) {
    fmt::print("calibration {:.2f} ms (p95 {:.2f}), {}\n", report.calibration.median,
               report.calibration.p95, report.device);
}

}  // namespace vellus::bench
