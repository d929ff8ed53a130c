#include "engine/frame_graph/synchronize.h"

namespace vellus::graph {

namespace {

void begin(CompileState& s) {
    Plan& plan = *s.plan;
    plan.prologue.clear();
    plan.steps.clear();
    plan.barriers.clear();
    plan.epilogue.clear();
    plan.attachments.clear();
    plan.prologue.push_back({.src_stages = kAllStages,
                             .src_access = VK_ACCESS_MEMORY_WRITE_BIT,
                             .dst_stages = kAllStagesAndHost,
                             .dst_access = kAllAccess,
                             .reason = Reason::kFrameStart,
                             .global = true});
    s.states.resize(s.graph->resources().size());
    s.sub_states.clear();
    for (const uint32_t i : s.graph->externals()) {
        const ResourceRecord& resource = s.graph->resources()[i];
        s.states[i] = {};
        SyncState& state = s.states[i].whole;
        if (resource.origin == Origin::kHistoryPrevious) {
            state.layout = kHistoryLayout;
            state.defined = true;
        } else if (resource.before != Access::kNone) {
            if (resource.kind == ResourceKind::kImage) state.layout = info(resource.before).layout;
            state.defined = true;
        }
    }
}

Use use_of(const CompileState& s, const AccessRecord& access, uint32_t step) {
    const AccessInfo& how = info(access.access);
    Use use{.resource = access.resource,
            .range = access.range,
            .stages = how.stages,
            .access = how.access,
            .dst_stages = how.stages,
            .dst_access = how.access,
            .layout = access.image ? how.layout : VK_IMAGE_LAYOUT_UNDEFINED,
            .step = step,
            .image = access.image,
            .whole = access.whole,
            .write = access.write,
            .defines = access.write};
    if (!access.write) {
        const Readers& readers = s.readers(access.version);
        if (!access.image || !readers.mixed_layouts) {
            use.dst_stages = readers.stages;
            use.dst_access = readers.access;
        }
    }
    if (s.full_barriers) {
        use.dst_stages = kAllStagesAndHost;
        use.dst_access = kAllAccess;
    }
    return use;
}

void add_attachment(CompileState& s, const AccessRecord& access) {
    const ResourceRecord& resource = s.graph->resources()[access.resource];
    Attachment& attachment = s.plan->attachments.emplace_back();
    attachment.resource = access.resource;
    attachment.range = access.range;
    attachment.layout = info(access.access).layout;
    attachment.store = s.needed[access.version] != 0 || resource.origin != Origin::kTransient;
    attachment.read_only = !access.write;
    if (access.clear != kNoIndex) {
        attachment.load = s.graph->clears()[access.clear];
    } else {
        attachment.load.op = access.load;
    }
}

void add_attachments(CompileState& s, Step& step) {
    step.first_attachment = static_cast<uint32_t>(s.plan->attachments.size());
    const auto accesses = s.graph->accesses(step.index);
    for (const AccessRecord& access : accesses) {
        if (access.access != Access::kColorAttachment) continue;
        add_attachment(s, access);
        ++step.color_count;
    }
    for (const AccessRecord& access : accesses) {
        if (access.access != Access::kDepthAttachment && access.access != Access::kDepthReadOnly) {
            continue;
        }
        add_attachment(s, access);
        step.has_depth = true;
    }
}

Step& begin_step(CompileState& s, StepKind kind, uint32_t index) {
    const auto first = static_cast<uint32_t>(s.plan->barriers.size());
    const auto to = static_cast<uint32_t>(s.plan->steps.size());
    Step& step = s.plan->steps.emplace_back();
    step.kind = kind;
    step.index = index;
    step.first_barrier = first;
    if (s.full_barriers) {
        s.plan->barriers.push_back({.src_stages = kAllStagesAndHost,
                                    .src_access = VK_ACCESS_MEMORY_WRITE_BIT,
                                    .dst_stages = kAllStagesAndHost,
                                    .dst_access = kAllAccess,
                                    .from = to == 0 ? kNoIndex : to - 1,
                                    .to = to,
                                    .reason = Reason::kFullBarrier,
                                    .global = true});
    }
    return step;
}

void end_step(CompileState& s, Step& step) {
    step.barrier_count = static_cast<uint32_t>(s.plan->barriers.size()) - step.first_barrier;
}

void poison(CompileState& s, uint32_t resource) {
    const auto index = static_cast<uint32_t>(s.plan->steps.size());
    Step& step = begin_step(s, StepKind::kPoison, resource);
    const ResourceRecord& record = s.graph->resources()[resource];
    const bool image = record.kind == ResourceKind::kImage;
    AccessRecord fill{.resource = resource,
                      .range = {0, static_cast<uint16_t>(image ? record.image.mips : 1), 0,
                                static_cast<uint16_t>(image ? record.image.layers : 1)},
                      .access = Access::kTransferWrite,
                      .write = true,
                      .image = image};
    Use use = use_of(s, fill, index);
    use.defines = false;
    synchronize(s, use, s.plan->barriers);
    end_step(s, step);
}

/// Memory for a transient resource where it is used first.
void make_room(CompileState& s, const AccessRecord& access, Placement& placement, uint32_t step) {
    if (placement.pool != kNoIndex ||
        s.graph->resources()[access.resource].origin != Origin::kTransient) {
        return;
    }
    place(s, access.resource);
    placement.first_step = step;
}

/// The switch: what takes over memory is filled with a pattern first, in a step of its own.
void poison_new(CompileState& s, uint32_t pass) {
    for (const AccessRecord& access : s.graph->accesses(pass)) {
        Placement& placement = s.plan->placements[access.resource];
        const bool placed = placement.pool != kNoIndex;
        make_room(s, access, placement, static_cast<uint32_t>(s.plan->steps.size()));
        if (!placed && placement.pool != kNoIndex) poison(s, access.resource);
    }
}

void give_back(CompileState& s, uint32_t step) {
    for (const uint32_t resource : s.stack) {
        ResourceState& state = s.states[resource];
        if (state.block == kNoIndex) continue;  // listed twice
        release(s, resource);
        state.block = kNoIndex;
        s.plan->placements[resource].last_step = step;
    }
}

bool has_content(const CompileState& s, const AccessRecord& access, bool defined) {
    if (defined) return true;
    const bool loads = access.load == Load::kKeep && (access.access == Access::kColorAttachment ||
                                                      access.access == Access::kDepthAttachment);
    if (access.write && !info(access.access).reads && !loads) return true;
    s.report(Problem::kReadNeverWritten, access.pass, access.resource, access.where);
    return false;
}

bool schedule_pass(CompileState& s, uint32_t position) {
    const uint32_t pass = s.order[position];
    if (s.options->switches.poison) poison_new(s, pass);
    const auto index = static_cast<uint32_t>(s.plan->steps.size());
    s.stack.clear();  // resources used for the last time
    bool complete = true;
    Step& step = begin_step(s, StepKind::kPass, pass);
    for (const AccessRecord& access : s.graph->accesses(pass)) {
        Placement& placement = s.plan->placements[access.resource];
        make_room(s, access, placement, index);
        if (!already_visible(s.states[access.resource], access, info(access.access), index)) {
            const bool defined = synchronize(s, use_of(s, access, index), s.plan->barriers);
            complete = has_content(s, access, defined) && complete;
        }
        if (placement.last_step == position && placement.pool != kNoIndex) {
            s.stack.push_back(access.resource);
        }
    }
    if (s.graph->passes()[pass].kind == PassKind::kRaster) add_attachments(s, step);
    end_step(s, step);
    give_back(s, index);
    return complete;
}

/// Leaves what outlives the frame as its owner expects it.
bool hand_over(CompileState& s) {
    bool complete = true;
    for (const uint32_t index : s.graph->externals()) {
        const ResourceRecord& resource = s.graph->resources()[index];
        const bool history =
            resource.origin == Origin::kHistoryNext && s.plan->placements[index].usage != 0;
        if (!history && resource.after == Access::kNone) continue;
        AccessInfo how = info(resource.after);
        if (history) {
            how = {.stages = kAllStages,
                   .access = VK_ACCESS_MEMORY_READ_BIT,
                   .layout = kHistoryLayout};
        }
        const bool image = resource.kind == ResourceKind::kImage;
        const Use use{.resource = index,
                      .range = {0, static_cast<uint16_t>(image ? resource.image.mips : 1), 0,
                                static_cast<uint16_t>(image ? resource.image.layers : 1)},
                      .stages = how.stages,
                      .access = how.access,
                      .dst_stages = how.stages,
                      .dst_access = how.access,
                      .layout = image ? how.layout : VK_IMAGE_LAYOUT_UNDEFINED,
                      .image = image};
        if (synchronize(s, use, s.plan->epilogue) || !history) continue;
        s.report(Problem::kMissingHistory, kNoIndex, index, resource.where);
        complete = false;
    }
    return complete;
}

}  // namespace

bool schedule(CompileState& s) {
    begin(s);
    begin_placement(s);
    bool complete = true;
    for (uint32_t position = 0; position < s.order.size(); ++position) {
        complete = schedule_pass(s, position) && complete;
    }
    complete = hand_over(s) && complete;
    end_placement(s);
    return complete;
}

}  // namespace vellus::graph
