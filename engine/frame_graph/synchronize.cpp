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

/// The barrier that `use` needs on one subresource, if any; moves `state` past the use.
bool advance(SyncState& state, const Use& use, Barrier& barrier) {
    const bool transition = state.layout != use.layout;
    const bool visible = state.write_stages == 0 || (within(use.stages, state.visible_stages) &&
                                                     within(use.access, state.visible_access));
    const bool touched = (state.write_stages | state.read_stages) != 0;
    const bool hazard = use.write ? touched : !visible;
    const bool needed = transition || hazard;
    if (needed) {
        const bool waits_for_reads = use.write || transition;
        barrier = {.resource = use.resource,
                   .src_stages = state.write_stages | (waits_for_reads ? state.read_stages : 0),
                   .src_access = state.write_access,
                   .dst_stages = use.dst_stages,
                   .dst_access = use.dst_access,
                   .old_layout = state.layout,
                   .new_layout = use.layout,
                   .from = state.last_step,
                   .to = use.step,
                   .reason = reason_of(state, use, visible)};
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
    return needed;
}

bool same_but_range(const Barrier& a, const Barrier& b) {
    return a.resource == b.resource && a.src_stages == b.src_stages &&
           a.src_access == b.src_access && a.dst_stages == b.dst_stages &&
           a.dst_access == b.dst_access && a.old_layout == b.old_layout &&
           a.new_layout == b.new_layout && a.from == b.from && a.to == b.to &&
           a.reason == b.reason && a.global == b.global;
}

/// Puts one barrier into its batch, joined with the one before where their ranges are neighbours.
void emit(CompileState& s, Barrier barrier, std::vector<Barrier>& batch, size_t batch_start) {
    const bool first = barrier.src_stages == 0;
    std::vector<Barrier>& target =
        first && barrier.reason != Reason::kFinalState ? s.plan->prologue : batch;
    if (first || s.options->switches.full_barriers || s.options->switches.immediate) {
        barrier.src_stages = first ? kAllStages : kAllStagesAndHost;
        barrier.src_access = VK_ACCESS_MEMORY_WRITE_BIT;
    }
    if (barrier.reason != Reason::kFinalState) {
        const bool gains_layout = barrier.old_layout != barrier.new_layout &&
                                  barrier.old_layout == VK_IMAGE_LAYOUT_UNDEFINED;
        if (first)
            barrier.reason = Reason::kFirstUse;
        else if (gains_layout)
            barrier.reason = Reason::kAlias;
    }
    if (!target.empty() && (&target != &batch || target.size() > batch_start)) {
        Barrier& last = target.back();
        if (same_but_range(last, barrier) && last.range.mip == barrier.range.mip &&
            last.range.mips == barrier.range.mips &&
            last.range.layer + last.range.layers == barrier.range.layer) {
            last.range.layers = static_cast<uint16_t>(last.range.layers + barrier.range.layers);
            return;
        }
    }
    target.push_back(barrier);
}

void split(CompileState& s, ResourceState& state, const ImageDesc& desc) {
    if (state.split != kNoIndex) return;
    state.split = static_cast<uint32_t>(s.sub_states.size());
    s.sub_states.insert(s.sub_states.end(), size_t{desc.layers} * desc.mips, state.whole);
}

/// The writes of the memory's former owners become available, whatever they wrote it through.
void wait_for_former_owners(ResourceState& state, const Use& use, std::vector<Barrier>& batch) {
    state.aliased = false;
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

}  // namespace

bool synchronize(CompileState& s, const Use& use, std::vector<Barrier>& batch) {
    ResourceState& state = s.states[use.resource];
    const ResourceRecord& record = s.graph->resources()[use.resource];
    const size_t start = batch.size();
    const bool image = record.kind == ResourceKind::kImage;
    if (state.aliased && image && state.block.tag.write_access == 0) {
        state.aliased = false;  // nothing to make available: the layout transition waits
    }
    if (state.aliased) {
        wait_for_former_owners(state, use, batch);
        if (!image) state.whole = {.defined = state.whole.defined};
    }
    const ImageDesc& desc = record.image;
    const bool all = !image || (use.range.mips == desc.mips && use.range.layers == desc.layers);
    Barrier barrier;
    if (all && state.split == kNoIndex) {
        const bool defined = state.whole.defined;
        if (advance(state.whole, use, barrier)) {
            barrier.range = use.range;
            emit(s, barrier, batch, start);
        }
        return defined;
    }
    split(s, state, desc);
    bool defined = true;
    for (uint32_t mip = use.range.mip; mip < uint32_t{use.range.mip} + use.range.mips; ++mip) {
        for (uint32_t layer = use.range.layer; layer < uint32_t{use.range.layer} + use.range.layers;
             ++layer) {
            SyncState& sub = s.sub_states[state.split + layer * desc.mips + mip];
            defined = defined && sub.defined;
            if (!advance(sub, use, barrier)) continue;
            barrier.range = {static_cast<uint16_t>(mip), 1, static_cast<uint16_t>(layer), 1};
            emit(s, barrier, batch, start);
        }
    }
    if (all && use.write) {  // every part is in one state again
        state.whole = s.sub_states[state.split];
        state.split = kNoIndex;
    }
    return defined;
}

}  // namespace vellus::graph
