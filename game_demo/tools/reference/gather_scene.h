#pragma once

#include "game_demo/tools/reference/cpu_host.h"
#include "modules/hair/reference/tracer/scene.h"

namespace vellus::demo {

/// The world as it is placed now, for the path tracer: hair, meshes, lights, environment and the
/// active camera, with the meaning that the demo's shaders give to every component.
hair::tracer::Scene gather_scene(CpuHost& host);

}  // namespace vellus::demo
