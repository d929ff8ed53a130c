#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::demo {

/// A figure over many frames: its median, and between which values eight in ten lie.
struct Spread {
    double median = 0.0;
    double low = 0.0;   ///< 10th percentile
    double high = 0.0;  ///< 90th
};
Spread spread_of(std::vector<double> samples);

/// The axis of rows that measure a whole frame in which one axis alone differs from base_choices();
/// their technique is "AXIS=TECHNIQUE", or kBase.
constexpr const char* kFrameAxis = "frame";
constexpr const char* kBase = "base";

/// One technique at one setting in one picture: how far off it was, and what it took.
struct AccuracyRow {
    std::string id;  ///< unique in its table, fit for file names
    std::string axis;
    std::string technique;
    std::string setting;  ///< empty: as the demo has it; else "NAME=VALUE"
    std::string groom;
    std::string colour;
    std::string light;
    std::string device;
    std::string run;                         ///< all other options that decide the result
    bool reference = false;                  ///< what the others of its axis are compared with
    double error = 0.0;                      ///< what charts show, see error_name()
    std::map<std::string, double> measures;  ///< further figures by name
    Spread axis_ms;                          ///< device time of the passes of this axis
    Spread frame_ms;                         ///< device time of the whole frame
    uint64_t transient_bytes = 0;
    uint64_t persistent_bytes = 0;
    uint32_t frames = 0;  ///< counted
    /// Files relative to the table's: picture, reference, difference.
    std::array<std::string, 3> pictures;
};

/// What AccuracyRow::error is on an axis, in words.
std::string_view error_name(std::string_view axis);

/// The rows of one run, or of several that were merged.
struct AccuracyTable {
    std::string device;
    std::string driver;
    std::string command;
    std::string date;  ///< UTC, ISO 8601
    uint64_t seed = 0;
    uint32_t size = 0;  ///< pixels along a side
    std::vector<AccuracyRow> rows;
};

nlohmann::ordered_json row_json(const AccuracyRow& row);
std::string to_json(const AccuracyTable& table);

/// Errors name the file and what it lacks.
Result<AccuracyRow> load_accuracy_row(const std::filesystem::path& path);
Result<AccuracyTable> load_accuracy(const std::filesystem::path& path);

}  // namespace vellus::demo
