#pragma once

#include <atomic>
#include <map>

#include "game_demo/tools/accuracy/frames.h"
#include "game_demo/tools/accuracy/trace.h"

namespace vellus::demo {

/// What jobs are compared with; each is made once and kept in a folder for the next run.
class References {
  public:
    References(gpu::Device& device, std::filesystem::path folder, const JobSizes& sizes,
               const std::atomic<bool>& stop)
        : device_(device), folder_(std::move(folder)), sizes_(sizes), stop_(stop) {}

    /// opacity: 64 samples a pixel (8 x 8 times the pixels, `dither_still`); shadow: exact
    /// transmittance; scattering: the technique `deon`; all else: path traced.
    Result<const Reference*> find(const Job& job);
    /// Grown when first asked for.
    Result<const StudioGroom*> groom(const std::string& name);
    /// Name of a job's reference: the same for jobs that share one.
    [[nodiscard]] static std::string name(const Job& job);

  private:
    Result<Reference> make(const Job& job);
    Result<Reference> supersampled(const StudioGroom& groom);
    Result<Reference> exact_shadow(const StudioGroom& groom, const StudioLook& look);
    Result<Reference> best_technique(const StudioGroom& groom, const Job& job);
    [[nodiscard]] std::filesystem::path file(const std::string& name) const;

    gpu::Device& device_;
    std::filesystem::path folder_;
    JobSizes sizes_;
    const std::atomic<bool>& stop_;
    std::map<std::string, StudioGroom> grooms_;
    std::map<std::string, Reference> made_;
    Subject subject_;  ///< whose references are in memory
};

/// How a job's frames are drawn: which axes are at which technique, the others being the demo's
/// own, or off where they would add to the error of the axis.
FrameRun frame_run(const Job& job, const JobSizes& sizes);

}  // namespace vellus::demo
