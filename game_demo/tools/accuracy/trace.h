#pragma once

#include <atomic>

#include "game_demo/tools/accuracy/radiance.h"
#include "game_demo/tools/accuracy/studio.h"
#include "modules/hair/reference/tracer/scene.h"

namespace vellus::demo {

/// The studio as columns for the path tracer.
Result<hair::tracer::Scene> trace_scene(const StudioGroom& groom, const StudioLook& look,
                                        uint32_t size);

/// Side of the blocks that path traced pictures are compared by.
constexpr uint32_t kTracedBlock = 4;

/// Path traced before black; weights are shares of hair; pixels without hair get few samples. Ends
/// with an Error once `stop` is set.
Result<Reference> path_traced(hair::tracer::Scene scene, uint32_t size, uint32_t samples,
                              uint64_t seed, const std::atomic<bool>& stop);

/// By pixel: which share of it is hair, and how much of the first light (a sun) arrives there past
/// hair and ball, as the mean over where rays through the pixel meet hair; 1 where none does.
struct VisibleHair {
    std::vector<float> share;
    std::vector<float> transmittance;
};
Result<VisibleHair> trace_visible(const hair::tracer::Scene& scene, uint32_t size, uint32_t rays,
                                  uint64_t seed);

}  // namespace vellus::demo
