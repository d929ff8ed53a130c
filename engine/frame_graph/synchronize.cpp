#include "engine/frame_graph/synchronize.h"

#include <algorithm>

namespace vellus::graph {

namespace {

bool same_but_range(const Barrier& a, const Barrier& b) {
    return a.resource == b.resource && a.src_stages == b.src_stages &&
           a.src_access == b.src_access && a.dst_stages == b.dst_stages &&
           a.dst_access == b.dst_access && a.old_layout == b.old_layout &&
           a.new_layout == b.new_layout && a.from == b.from && a.to == b.to &&
           a.reason == b.reason && a.global == b.global;
}

void split(CompileState& s, ResourceState& state, const ImageDesc& desc) {
    if (state.split != kNoIndex) return;
    state.split = static_cast<uint32_t>(s.sub_states.size());
    s.sub_states.insert(s.sub_states.end(), size_t{desc.layers} * desc.mips, state.whole);
}

}  // namespace

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

bool synchronize_parts(CompileState& s, ResourceState& state, Use use,
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

}  // namespace vellus::graph
