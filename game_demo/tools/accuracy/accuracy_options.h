#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace vellus::demo {

/// Part `index` of `count`: 0/1 is all.
struct Shard {
    uint32_t index = 0;
    uint32_t count = 1;
};

struct AccuracyOptions {
    std::filesystem::path out = "accuracy";
    bool quick = false;
    bool list = false;
    // Which rows; empty: all there are.
    std::vector<std::string> axes;
    std::vector<std::string> grooms;
    std::vector<std::string> colours;
    std::vector<std::string> lights;
    std::vector<std::string> techniques;
    // 0 in the next five: as a full or quick run has it.
    uint32_t size = 0;
    uint32_t frames = 0;
    uint32_t warm_up = 0;
    uint32_t samples = 0;
    uint32_t strands = 0;
    uint64_t seed = 0;
    std::string device;
    Shard shard;
    std::vector<std::filesystem::path> merge;
    std::optional<double> budget_ms;
    std::string command;  ///< as typed
};

/// Options, or the program's exit status where there is nothing to run, as parse_options.
struct ParsedAccuracyOptions {
    AccuracyOptions options;
    std::optional<int> exit_status;
};
ParsedAccuracyOptions parse_accuracy_options(int argc, const char* const* argv, std::ostream& out,
                                             std::ostream& err);

/// "3/8", the index below the count.
std::optional<Shard> read_shard(const std::string& text);

}  // namespace vellus::demo
