#include <algorithm>

#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

/// As the description counted them: every pass lives and runs where it is declared.
void take_declared_lifetimes(CompileState& s) {
    const auto resources = s.graph->resources();
    s.plan->placements.resize(resources.size());
    Placement* placement = s.plan->placements.data();
    for (const ResourceRecord& resource : resources) {
        *placement++ = {.usage = resource.usage,
                        .first_step = resource.first_pass,
                        .last_step = resource.last_pass};
    }
}

void count_lifetimes(CompileState& s) {
    s.plan->placements.assign(s.graph->resources().size(), {});
    s.live_readers.assign(s.graph->versions().size(), {});
    for (uint32_t position = 0; position < s.order.size(); ++position) {
        for (const AccessRecord& access : s.graph->accesses(s.order[position])) {
            const AccessInfo& how = info(access.access);
            Placement& placement = s.plan->placements[access.resource];
            placement.usage |= access.image ? how.image_usage : how.buffer_usage;
            if (placement.first_step == kNoIndex) placement.first_step = position;
            placement.last_step = position;
            if (!access.write) s.live_readers[access.version].add(how);
        }
    }
}

}  // namespace

void find_lifetimes(CompileState& s) {
    if (s.in_declared_order()) {
        take_declared_lifetimes(s);
    } else {
        count_lifetimes(s);
    }
    for (const OutputRecord& output : s.graph->outputs()) {
        s.plan->placements[s.graph->versions()[output.version].resource].last_step = kNoIndex;
    }
}

void begin_placement(CompileState& s) {
    s.plan->pools.clear();
    s.plan->transient_bytes = 0;
    s.plan->transient_unaliased_bytes = 0;
}

void place(CompileState& s, uint32_t resource) {
    const ResourceRecord& record = s.graph->resources()[resource];
    Placement& placement = s.plan->placements[resource];
    if (s.options->switches.poison) {
        const AccessInfo& fill = info(Access::kTransferWrite);
        placement.usage |=
            record.kind == ResourceKind::kImage ? fill.image_usage : fill.buffer_usage;
    }
    const MemoryNeeds needs =
        s.options->memory_needs(s.options->memory_user, record, placement.usage);
    uint32_t pool = 0;
    std::vector<Pool>& pools = s.plan->pools;
    while (pool < pools.size() &&
           (pools[pool].kind != record.kind || pools[pool].type_bits != needs.type_bits)) {
        ++pool;
    }
    if (pool == pools.size()) {
        pools.push_back({.kind = record.kind, .type_bits = needs.type_bits});
        if (s.maps.size() < pools.size()) s.maps.emplace_back();
        s.maps[pool].reset();
    }
    pools[pool].alignment = std::max(pools[pool].alignment, needs.alignment);
    s.plan->transient_unaliased_bytes += needs.bytes;
    const MemoryBlock block = s.maps[pool].allocate(needs.bytes, needs.alignment);
    placement.pool = pool;
    placement.offset = block.offset;
    placement.bytes = needs.bytes;
    ResourceState& state = s.states[resource];
    state.split = kNoIndex;
    state.block = block.node;
    state.aliased = block.tag.stages != 0;  // then the tag holds; else it is all zero
    SyncState& whole = state.whole;         // field by field: = {} copies through memory and stalls
    whole.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    whole.write_stages = block.tag.stages;
    whole.write_access = block.tag.write_access;
    whole.read_stages = 0;
    whole.visible_stages = 0;
    whole.visible_access = 0;
    whole.last_step = state.aliased ? block.tag.last_step : kNoIndex;
    whole.defined = false;
}

void release(CompileState& s, uint32_t resource) {
    if (s.options->switches.no_aliasing) return;
    const ResourceState& state = s.states[resource];
    MemoryTag tag;
    const auto add = [&](const SyncState& sync) {
        tag.stages |= sync.write_stages | sync.read_stages;
        tag.write_access |= sync.write_access;
        tag.last_step = std::max(tag.last_step == kNoIndex ? 0 : tag.last_step,
                                 sync.last_step == kNoIndex ? 0 : sync.last_step);
    };
    if (state.split == kNoIndex) {
        add(state.whole);
    } else {
        const ImageDesc& desc = s.graph->resources()[resource].image;
        for (uint32_t i = 0; i < desc.layers * desc.mips; ++i) {
            add(s.sub_states[state.split + i]);
        }
    }
    s.maps[s.plan->placements[resource].pool].free(state.block, tag);
}

void end_placement(CompileState& s) {
    for (size_t pool = 0; pool < s.plan->pools.size(); ++pool) {
        s.plan->pools[pool].bytes = s.maps[pool].high_water();
        s.plan->transient_bytes += s.maps[pool].high_water();
    }
}

}  // namespace vellus::graph
