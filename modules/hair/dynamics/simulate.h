#pragma once

#include <span>

#include "modules/hair/dynamics/guides.h"
#include "modules/hair/dynamics/rod.h"

namespace vellus::hair {

/// One frame of all guides on all cores: `params.substeps` steps of `params.step` seconds, while
/// roots (one per guide) and capsules go from where they were to where they are. The result depends
/// neither on the number of cores nor on how guides share lanes. At most 32 capsules.
void simulate(const GuideSet& guides, const glsl::RodParams& params,
              std::span<const glsl::RodRoot> roots, std::span<const glsl::RodCapsule> capsules,
              GuideState& state);

}  // namespace vellus::hair
