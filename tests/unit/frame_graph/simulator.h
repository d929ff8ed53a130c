#pragma once

#include <string>

#include "engine/frame_graph/compile.h"

namespace vellus::graph::test {

/// Executes a plan on abstract memory by the rules of the Vulkan specification alone: which version
/// every byte holds, the layout of every subresource, and which accesses barriers have ordered and
/// made visible. Knows nothing of how the compiler works. Returns what is wrong first, or "".
std::string simulate(const GraphDescription& graph, const CompileOptions& options,
                     const Plan& plan);

}  // namespace vellus::graph::test
