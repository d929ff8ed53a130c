#include "engine/frame_graph/synchronize.h"

#include <algorithm>

namespace vellus::graph {

namespace {

bool within(uint32_t part, uint32_t whole) {
    return (part & ~whole) == 0;
}

Reason reason_of(const SyncState& state, const Use& use, bool visible) {
    if (use.step == kNoIndex) return Reason::kFinalState;
    if (use.write) return state.read_stages ? Reason::kWriteAfterRead : Reason::kWriteAfterWrite;
    return visible ? Reason::kLayoutChange : Reason::kReadAfterWrite;
}

bool same_but_range(const Barrier& a, const Barrier& b) {
    return a.resource == b.resource && a.src_stages == b.src_stages &&
           a.src_access == b.src_access && a.dst_stages == b.dst_stages &&
           a.dst_access == b.dst_access && a.old_layout == b.old_layout &&
           a.new_layout == b.new_layout && a.from == b.from && a.to == b.to &&
           a.reason == b.reason && a.global == b.global;
}

/// Joins the last barrier of a batch with the one before where their ranges are neighbours.
void join(std::vector<Barrier>& batch) {
    if (batch.size() < 2) return;
    const Barrier& last = batch.back();
    Barrier& before = batch[batch.size() - 2];
    if (!same_but_range(before, last) || before.range.mip != last.range.mip ||
        before.range.mips != last.range.mips ||
        before.range.layer + before.range.layers != last.range.layer) {
        return;
    }
    before.range.layers = static_cast<uint16_t>(before.range.layers + last.range.layers);
    batch.pop_back();
}

/// Appends the barrier from `state` to `use` where it belongs.
void emit(CompileState& s, const SyncState& state, const Use& use, const ImageRange& range,
          bool transition, bool visible, std::vector<Barrier>& batch) {
    const bool waits_for_reads = use.write || transition;
    const uint32_t src = state.write_stages | (waits_for_reads ? state.read_stages : 0);
    const bool first = src == 0;
    const bool final = use.step == kNoIndex;
    const bool everything = s.options->switches.full_barriers || s.options->switches.immediate;
    std::vector<Barrier>& target = first && !final ? s.plan->prologue : batch;
    Barrier& b = target.emplace_back();
    b.resource = use.resource;
    b.src_stages = first ? kAllStages : everything ? kAllStagesAndHost : src;
    b.src_access = state.write_access;
    if (first || everything) b.src_access = VK_ACCESS_MEMORY_WRITE_BIT;
    b.dst_stages = use.dst_stages;
    b.dst_access = use.dst_access;
    b.old_layout = state.layout;
    b.new_layout = use.layout;
    b.range = range;
    b.from = state.last_step;
    b.to = use.step;
    b.reason = reason_of(state, use, visible);
    if (!final && first) {
        b.reason = Reason::kFirstUse;
    } else if (!final && transition && state.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
        b.reason = Reason::kAlias;
    }
    if (!use.whole) join(target);
}

/// Adds the barrier that `use` needs on one subresource, if any, and moves `state` past the use.
inline void advance(CompileState& s, SyncState& state, const Use& use, const ImageRange& range,
                    std::vector<Barrier>& batch) {
    const bool transition = state.layout != use.layout;
    const bool visible = state.write_stages == 0 || (within(use.stages, state.visible_stages) &&
                                                     within(use.access, state.visible_access));
    const bool touched = (state.write_stages | state.read_stages) != 0;
    if (transition || (use.write ? touched : !visible)) {
        emit(s, state, use, range, transition, visible, batch);
        if (transition) {
            // The transition writes the image; its result is available, and visible to dst.
            state.write_stages = use.dst_stages;
            state.write_access = 0;
            state.read_stages = 0;
            state.visible_stages = 0;
            state.visible_access = 0;
        }
        state.visible_stages |= use.dst_stages;
        state.visible_access |= use.dst_access;
    }
    state.layout = use.layout;
    state.last_step = use.step;
    if (use.write) {
        state.write_stages = use.stages;
        state.write_access = use.access & kWriteBits;
        state.read_stages = 0;
        state.visible_stages = 0;
        state.visible_access = 0;
    } else {
        state.read_stages |= use.stages;
    }
    state.defined = state.defined || use.defines;
}

void split(CompileState& s, ResourceState& state, const ImageDesc& desc) {
    if (state.split != kNoIndex) return;
    state.split = static_cast<uint32_t>(s.sub_states.size());
    s.sub_states.insert(s.sub_states.end(), size_t{desc.layers} * desc.mips, state.whole);
}

/// The writes of the memory's former owners become available, whatever they wrote it through.
void wait_for_former_owners(const ResourceState& state, const Use& use,
                            std::vector<Barrier>& batch) {
    batch.push_back({.resource = use.resource,
                     .src_stages = state.block.tag.stages,
                     .src_access = state.block.tag.write_access,
                     .dst_stages = use.dst_stages,
                     .dst_access = use.dst_access,
                     .from = state.block.tag.last_step,
                     .to = use.step,
                     .reason = Reason::kAlias,
                     .global = true});
}

bool synchronize_parts(CompileState& s, ResourceState& state, const Use& use,
                       std::vector<Barrier>& batch) {
    const ImageDesc& desc = s.graph->resources()[use.resource].image;
    split(s, state, desc);
    Use part = use;
    part.whole = false;
    bool defined = true;
    for (uint32_t mip = use.range.mip; mip < uint32_t{use.range.mip} + use.range.mips; ++mip) {
        for (uint32_t layer = use.range.layer; layer < uint32_t{use.range.layer} + use.range.layers;
             ++layer) {
            SyncState& sub = s.sub_states[state.split + layer * desc.mips + mip];
            defined = defined && sub.defined;
            const ImageRange one{static_cast<uint16_t>(mip), 1, static_cast<uint16_t>(layer), 1};
            advance(s, sub, part, one, batch);
        }
    }
    if (use.whole && use.write) {  // every part is in one state again
        state.whole = s.sub_states[state.split];
        state.split = kNoIndex;
    }
    return defined;
}

}  // namespace

bool synchronize(CompileState& s, const Use& use, std::vector<Barrier>& batch) {
    ResourceState& state = s.states[use.resource];
    if (state.aliased) {
        // Without writes there is nothing to make available, and an image's transition waits.
        if (!use.image || state.block.tag.write_access != 0) {
            wait_for_former_owners(state, use, batch);
        }
        state.aliased = false;
        if (!use.image) state.whole = {};
    }
    if (use.whole && state.split == kNoIndex) {
        const bool defined = state.whole.defined;
        advance(s, state.whole, use, use.range, batch);
        return defined;
    }
    return synchronize_parts(s, state, use, batch);
}

}  // namespace vellus::graph
