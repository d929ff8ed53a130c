#pragma once

#include <cstdint>

#include "engine/frame_graph/description.h"

namespace vellus::bench {

/// chain: each pass reads the image before and makes one. busy: it reads the two before and a
/// buffer too, which every fifth pass updates. Every fourth pass draws.
enum class GraphShape : uint8_t { kChain, kBusy };
const char* name_of(GraphShape shape);

/// A frame of `passes` passes, described anew; all of them are needed for its output.
void describe_frame(graph::GraphDescription& graph, GraphShape shape, uint32_t passes);

/// An image lives for three passes, so four places serve them all, beside the buffer.
constexpr uint64_t kMostTransientBytes = 4 * 1280 * 720 * 8 + (1 << 20);

}  // namespace vellus::bench
