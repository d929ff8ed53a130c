#pragma once

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
    const gpu::Pipeline* resolve = nullptr;
};

/// System: moves the picture by a part of a pixel, a new one each frame (Halton 2, 3), so that the
/// history sees every part; none where TAA is off.
void jitter_view(Res<const TemporalSettings> settings, Res<const scene::FixedStep> step,
                 Res<scene::ViewSettings> view);

/// System: pass "temporal/taa", the picture blended into its history.
void describe_taa(Res<const TemporalSettings> settings, Res<const scene::ViewSettings> view,
                  Res<TemporalPipelines> pipelines, Res<scene::RenderFrame> frame);

}  // namespace vellus::temporal
