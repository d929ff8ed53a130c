#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/frame_graph/types.h"

namespace vellus::graph {

class GraphDescription;

/// What a description, or a pass while recording, did wrong.
enum class Problem : uint8_t {
    kReadNeverWritten,
    kStaleHandle,
    kTwoWriters,
    kConflictingAccess,
    kUndeclaredAccess,
    kMissingHistory,
    kCycle,
    kUnsupportedFormat,
    kUnsupportedUsage,
    kOutputOverwritten,
};

/// One mistake as data; indices are into the description, kNone where there is none.
struct Diagnostic {
    Problem problem = Problem::kStaleHandle;
    uint32_t pass = ~0U;
    uint32_t resource = ~0U;
    uint32_t other_pass = ~0U;
    SourceLine where;
};

using Diagnostics = std::vector<Diagnostic>;

/// "file:line: pass 'x': ... 'resource' ... (remedy)", one line.
std::string describe(const GraphDescription& graph, const Diagnostic& diagnostic);
/// All of them, one a line.
std::string describe(const GraphDescription& graph, std::span<const Diagnostic> diagnostics);

}  // namespace vellus::graph
