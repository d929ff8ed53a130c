#pragma once

#include "game_demo/tools/reference/cpu_host.h"
#include "modules/hair/reference/tracer/scene.h"

namespace vellus::demo {

/// All hair of the world that can be seen, points relative to `camera`.
void gather_hair(CpuHost& host, const glm::dvec3& camera, std::vector<hair::tracer::Groom>& grooms);

}  // namespace vellus::demo
