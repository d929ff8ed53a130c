#pragma once

// Barriers for one access after another; internal to this folder.

#include <vector>

#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

/// One access to a range as synchronization sees it. `dst_*` may cover later readers as well.
struct Use {
    uint32_t resource = kNoIndex;
    ImageRange range{};
    uint32_t stages = 0;
    uint32_t access = 0;
    uint32_t dst_stages = 0;
    uint32_t dst_access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< UNDEFINED for buffers
    uint32_t step = kNoIndex;
    bool image = false;
    bool whole = true;  ///< the range is all of the resource
    bool write = false;
    bool defines = false;  ///< afterwards the range has content
};

/// A read that needs nothing: the layout is right and the last write visible to it.
inline bool already_visible(ResourceState& state, const AccessRecord& access, const AccessInfo& how,
                            uint32_t step) {
    SyncState& sync = state.whole;
    const VkImageLayout layout = access.image ? how.layout : VK_IMAGE_LAYOUT_UNDEFINED;
    if (access.write || !access.whole || state.split != kNoIndex || state.aliased ||
        sync.layout != layout || !sync.defined) {
        return false;
    }
    if (sync.write_stages != 0 &&
        ((how.stages & ~sync.visible_stages) != 0 || (how.access & ~sync.visible_access) != 0)) {
        return false;
    }
    sync.read_stages |= how.stages;
    sync.last_step = step;
    return true;
}

/// Appends what `use` needs to `batch`, or to the plan's prologue where nothing in the frame comes
/// before it, and moves the state on. Returns false if part of the range has no content yet.
bool synchronize(CompileState& s, const Use& use, std::vector<Barrier>& batch);

}  // namespace vellus::graph
