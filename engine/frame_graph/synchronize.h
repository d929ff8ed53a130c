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

/// Joins the last barrier of a batch with the one before where their ranges are neighbours.
void join(std::vector<Barrier>& batch);
bool synchronize_parts(CompileState& s, ResourceState& state, Use use, std::vector<Barrier>& batch);

inline Reason reason_of(const SyncState& state, const Use& use, bool transition, bool visible) {
    if (use.step == kNoIndex) return Reason::kFinalState;
    if (transition && state.layout == VK_IMAGE_LAYOUT_UNDEFINED) return Reason::kAlias;
    if (use.write) return state.read_stages ? Reason::kWriteAfterRead : Reason::kWriteAfterWrite;
    return visible ? Reason::kLayoutChange : Reason::kReadAfterWrite;
}

/// Appends the barrier from `state` to `use` where it belongs.
inline void emit(CompileState& s, const SyncState& state, const Use& use, const ImageRange& range,
                 bool transition, bool visible, std::vector<Barrier>& batch) {
    const bool waits_for_reads = use.write || transition;
    const uint32_t src = state.write_stages | (waits_for_reads ? state.read_stages : 0);
    const bool first = src == 0;
    std::vector<Barrier>& target = first && use.step != kNoIndex ? s.plan->prologue : batch;
    Barrier& b = target.emplace_back();
    b.resource = use.resource;
    b.src_stages = first ? kAllStages : s.full_barriers ? kAllStagesAndHost : src;
    b.src_access =
        first || s.full_barriers ? uint32_t{VK_ACCESS_MEMORY_WRITE_BIT} : state.write_access;
    b.dst_stages = use.dst_stages;
    b.dst_access = use.dst_access;
    b.old_layout = state.layout;
    b.new_layout = use.layout;
    b.range = range;
    b.from = state.last_step;
    b.to = use.step;
    b.reason = first && use.step != kNoIndex ? Reason::kFirstUse
                                             : reason_of(state, use, transition, visible);
    if (!use.whole) join(target);
}

/// Adds the barrier that `use` needs on one subresource, if any, and moves `state` past the use.
inline void advance(CompileState& s, SyncState& state, const Use& use, const ImageRange& range,
                    std::vector<Barrier>& batch) {
    const bool transition = state.layout != use.layout;
    const bool visible = state.write_stages == 0 || ((use.stages & ~state.visible_stages) == 0 &&
                                                     (use.access & ~state.visible_access) == 0);
    const bool touched = (state.write_stages | state.read_stages) != 0;
    const bool waits = transition || (use.write ? touched : !visible);
    if (waits) emit(s, state, use, range, transition, visible, batch);
    state.layout = use.layout;
    state.last_step = use.step;
    state.defined |= use.defines;
    if (use.write) {
        state.write_stages = use.stages;
        state.write_access = use.access & kWriteBits;
        state.read_stages = 0;
        state.visible_stages = 0;
        state.visible_access = 0;
        return;
    }
    if (transition) {
        // The transition writes the image; its result is available, and visible to dst.
        state.write_stages = use.dst_stages;
        state.write_access = 0;
        state.read_stages = 0;
        state.visible_stages = 0;
        state.visible_access = 0;
    }
    state.read_stages |= use.stages;
    if (waits) {
        state.visible_stages |= use.dst_stages;
        state.visible_access |= use.dst_access;
    }
}

/// The writes of the memory's former owners become available, whatever they wrote it through.
/// Without writes there is nothing to make available, and an image's transition waits.
inline void wait_for_former_owners(ResourceState& state, const Use& use,
                                   std::vector<Barrier>& batch) {
    state.aliased = false;
    if (use.image && state.whole.write_access == 0) return;
    Barrier& b = batch.emplace_back();
    b.resource = use.resource;
    b.src_stages = state.whole.write_stages;
    b.src_access = state.whole.write_access;
    b.dst_stages = use.dst_stages;
    b.dst_access = use.dst_access;
    b.from = state.whole.last_step;
    b.to = use.step;
    b.reason = Reason::kAlias;
    b.global = true;
    if (use.image) return;
    state.whole.write_stages = 0;  // nothing is left to wait for
    state.whole.write_access = 0;
}

/// Appends what `use` needs to `batch`, or to the plan's prologue where nothing in the frame comes
/// before it, and moves the state on. Returns false if part of the range has no content yet.
[[gnu::always_inline]] inline bool synchronize(CompileState& s, const Use& use,
                                               std::vector<Barrier>& batch) {
    ResourceState& state = s.states[use.resource];
    if (state.aliased) wait_for_former_owners(state, use, batch);
    if (!use.whole || state.split != kNoIndex) return synchronize_parts(s, state, use, batch);
    const bool defined = state.whole.defined;
    advance(s, state.whole, use, use.range, batch);
    return defined;
}

}  // namespace vellus::graph
