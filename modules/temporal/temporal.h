#pragma once

#include <array>

#include "engine/ecs/system.h"
#include "modules/scene/render_frame.h"
#include "modules/scene/view.h"

namespace vellus::temporal {

/// Temporal antialiasing: on or off at run time, and the share of the current frame in the history.
/// Resource.
struct TemporalSettings {
    bool enabled = true;
    float blend = 0.06f;
};

/// Made when the history is first resolved. Resource.
struct TemporalPipelines {
    const gpu::Pipeline* resolve = nullptr;       ///< where no hair is
    const gpu::Pipeline* resolve_hair = nullptr;  ///< near hair
};

/// System: moves the picture by a part of a pixel, a new one each frame (Halton 2, 3), so that the
/// history sees every part; none where TAA is off.
void jitter_view(Res<const TemporalSettings> settings, Res<const scene::FixedStep> step,
                 Res<scene::ViewSettings> view);

/// Parts of a picture for the two ways of resolving it: beside hair, and up to four around that.
struct TaaRegions {
    scene::PixelRect hair;
    std::array<scene::PixelRect, 4> others;  ///< the empty ones are none
};

/// Cuts a picture: `hair` grows by what its window reaches and to whole tiles.
TaaRegions cut_regions(const scene::PixelRect& hair, const glm::ivec2& size);

/// System: pass "temporal/taa", the picture blended into its history.
void describe_taa(Res<const TemporalSettings> settings, Res<const scene::ViewSettings> view,
                  Res<TemporalPipelines> pipelines, Res<scene::RenderFrame> frame);

}  // namespace vellus::temporal
