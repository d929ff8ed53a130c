#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::bench {

/// What was measured of one thing, over many frames or rounds.
struct Row {
    std::string name;  ///< unique in its report, e.g. "walk/hair/shade"
    std::string unit;  ///< "ms": divided by the calibration when compared; "bytes", "count": as is
    double median = 0.0;
    double p95 = 0.0;
    /// How far the median itself may be off by chance: 1.57 interquartile ranges / sqrt(n), half
    /// the width of a box plot's notch (McGill, Tukey and Larsen 1978), in the unit.
    double noise = 0.0;
    uint32_t samples = 0;
};

/// The middle one, of an even number the upper; 0 of none.
double median(std::vector<double> values);

/// Sorts `samples`; none gives a row of zeros.
Row make_row(std::string name, std::string unit, std::vector<double> samples);

/// The figures of one run, comparable with those of other machines by their ratio to `calibration`.
struct Report {
    std::string device;
    std::string command;
    Row calibration{.name = "calibration", .unit = "ms"};
    std::vector<Row> rows;
    std::map<std::string, std::string> hashes;  ///< of the last picture, by scene
};

/// Wall milliseconds of a fixed piece of work on all cores, arithmetic and memory by halves; about
/// 20 ms on two cores of 2020.
double run_calibration();

std::string to_json(const Report& report);
/// Errors name the file and the field.
Result<Report> load_report(const std::filesystem::path& path);

}  // namespace vellus::bench
