#include "tests/perf/report/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "engine/platform/jobs.h"
#include "engine/platform/quantile.h"

namespace vellus::bench {

namespace {

constexpr int kVersion = 1;

nlohmann::json row_json(const Row& row) {
    return {{"name", row.name}, {"unit", row.unit},   {"median", row.median},
            {"p95", row.p95},   {"noise", row.noise}, {"samples", row.samples}};
}

Row row_from(const nlohmann::json& json) {
    return {json.at("name"), json.at("unit"),  json.at("median"),
            json.at("p95"),  json.at("noise"), json.at("samples")};
}

}  // namespace

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    return values[values.size() / 2];
}

Row make_row(std::string name, std::string unit, std::vector<double> samples) {
    Row row{.name = std::move(name), .unit = std::move(unit)};
    if (samples.empty()) return row;
    std::ranges::sort(samples);
    row.samples = static_cast<uint32_t>(samples.size());
    row.median = quantile(samples, 0.5);
    row.p95 = quantile(samples, 0.95);
    const double between = quantile(samples, 0.75) - quantile(samples, 0.25);
    row.noise = 1.57 * between / std::sqrt(static_cast<double>(samples.size()));
    return row;
}

double run_calibration() {
    static std::vector<float> memory(size_t{4} << 20, 1.0f);
    const double start = wall_seconds();
    parallel_ranges(memory.size(), memory.size() / 16, [](size_t first, size_t last) {
        float value = 0.5f;
        for (size_t i = first; i < last; ++i) {
            for (int step = 0; step < 6; ++step) value = value * (1.9f - value) + 1e-3f;
            memory[i] = 0.5f * memory[i] + value;
        }
    });
    return 1e3 * (wall_seconds() - start);
}

std::string to_json(const Report& report) {
    nlohmann::json rows = nlohmann::json::array();
    for (const Row& row : report.rows) rows.push_back(row_json(row));
    const nlohmann::json json = {{"version", kVersion},
                                 {"device", report.device},
                                 {"command", report.command},
                                 {"calibration", row_json(report.calibration)},
                                 {"rows", rows},
                                 {"hashes", report.hashes}};
    return json.dump(1) + "\n";
}

Result<Report> load_report(const std::filesystem::path& path) {
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    const Error wrong{"is no report of vellus_bench", path.string(),
                      "make one with vellus_bench all --json FILE"};
    const auto* text = reinterpret_cast<const char*>(bytes->data());
    const auto json = nlohmann::json::parse(text, text + bytes->size(), nullptr, false);
    if (json.is_discarded()) return wrong;
    try {
        if (json.at("version") != kVersion) {
            return Error{"has another version than 1", path.string(), "measure it anew"};
        }
        Report report{.device = json.at("device"),
                      .command = json.at("command"),
                      .calibration = row_from(json.at("calibration")),
                      .hashes = json.at("hashes")};
        for (const auto& row : json.at("rows")) report.rows.push_back(row_from(row));
        return report;
    } catch (const nlohmann::json::exception& problem) {
        return Error{wrong.what + ": " + problem.what(), wrong.where, wrong.remedy};
    }
}

}  // namespace vellus::bench
