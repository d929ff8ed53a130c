#pragma once

#include "game_demo/tools/reference/reference_options.h"
#include "modules/hair/reference/tracer/scene.h"

namespace vellus::demo {

/// A scene of the demo, at the frame asked for, for the path tracer.
struct ReferenceScene {
    hair::tracer::Scene scene;
    float exposure = 1.0f;  ///< factor on the picture before the tone map
};
Result<ReferenceScene> load_reference(const ReferenceOptions& options);

/// Traces and writes the picture. The program's exit status: 0, 1 with one line on stderr, or 130
/// after Ctrl-C, with a picture of the samples there are.
int run_reference(const ReferenceOptions& options);

}  // namespace vellus::demo
