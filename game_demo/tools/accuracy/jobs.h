#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "game_demo/tools/accuracy/accuracy_options.h"

namespace vellus::demo {

constexpr std::array<std::string_view, 4> kGrooms = {"straight", "wavy", "curly", "fur"};
constexpr std::array<std::string_view, 4> kColours = {"black", "brown", "blond", "white"};
/// A sun from there; the sky alone; sun and sky.
constexpr std::array<std::string_view, 5> kLights = {"front", "side", "back", "environment",
                                                     "outdoors"};

/// The axes of techniques.h, then kFrameAxis.
std::vector<std::string> measured_axes();

/// What jobs share one reference by, apart from the axis.
struct Subject {
    std::string groom;
    std::string colour;
    std::string light;

    bool operator==(const Subject&) const = default;
    bool operator<(const Subject& other) const {
        return std::tie(groom, colour, light) < std::tie(other.groom, other.colour, other.light);
    }
};

/// One row to be measured; independent of all others.
struct Job {
    Subject subject;
    std::string axis;
    std::string technique;
    std::string setting;
    bool reference = false;

    /// Unique, letters, digits and -._ only.
    [[nodiscard]] std::string id() const;
};

/// How large and how long every job is.
struct JobSizes {
    uint32_t size = 160;
    uint32_t frames = 16;
    uint32_t warm_up = 48;  ///< where TAA's history matters
    uint32_t samples = 128;
    uint32_t strands = 6000;
    uint64_t seed = 0;
};
JobSizes job_sizes(const AccuracyOptions& options);
/// All that decides a result besides the job and the device: the sizes, and a fingerprint of the
/// program.
std::string describe(const JobSizes& sizes);

/// The jobs asked for, without regard to the shard: jobs of one subject follow each other. The
/// same options give the same list.
std::vector<Job> all_jobs(const AccuracyOptions& options);
/// Those of one shard: whole subjects, so that no two machines trace the same reference.
std::vector<Job> jobs_of_shard(const std::vector<Job>& jobs, const Shard& shard);

}  // namespace vellus::demo
