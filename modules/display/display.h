#pragma once

#include "engine/ecs/system.h"
#include "modules/scene/render_frame.h"
#include "modules/scene/view.h"

namespace vellus::display {

/// Made when a picture is first shown. Resource.
struct DisplayPipelines {
    const gpu::Pipeline* tonemap = nullptr;
};

/// System: pass "display/tonemap", exposure, tone map and sRGB encoding into RenderFrame::display.
void describe_tonemap(Res<const scene::ViewSettings> view, Res<DisplayPipelines> pipelines,
                      Res<scene::RenderFrame> frame);

}  // namespace vellus::display
