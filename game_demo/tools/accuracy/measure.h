#pragma once

#include "game_demo/src/accuracy/table.h"
#include "game_demo/tools/accuracy/references.h"

namespace vellus::demo {

/// Draws a job's frames, compares them with its reference, and writes OUT/jobs/ID.json last, after
/// ID.picture.png, ID.difference.png and OUT/references/NAME.png.
class Measure {
  public:
    Measure(gpu::Device& device, std::filesystem::path out, const JobSizes& sizes,
            const std::atomic<bool>& stop);

    Result<AccuracyRow> run(const Job& job);
    /// The whole frame with these choices, for groom and colour, under sun and sky: error and time
    /// as in rows of kFrameAxis. Writes nothing but the reference.
    Result<Combination> run_combination(const Subject& subject, std::vector<AxisChoice> choices);
    /// Whether a row on file is of this run on this device.
    [[nodiscard]] bool is_of_this_run(const AccuracyRow& row) const;
    [[nodiscard]] std::filesystem::path row_file(const Job& job) const;

  private:
    Result<DrawnFrames> draw(const Job& job);
    Result<const std::vector<Radiance>*> unshadowed(const Job& job);
    Result<void> save_pictures(const Job& job, const Radiance& mean, const Reference& reference,
                               AccuracyRow& row);

    gpu::Device& device_;
    std::filesystem::path out_;
    JobSizes sizes_;
    References references_;
    std::string unshadowed_of_;  ///< which subject's
    std::vector<Radiance> unshadowed_;
};

}  // namespace vellus::demo
