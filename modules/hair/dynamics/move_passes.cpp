#include "modules/hair/dynamics/move_passes.h"

#include "engine/frame_graph/context.h"
#include "modules/hair/geometry/strand_raster.h"

namespace vellus::hair {

namespace {

VkDeviceAddress turns_of(const GroomMotion& groom, uint32_t slot) {
    return groom.device ? groom.device->turns(slot)
                        : groom.buffers->turns.address() + slot * groom.turn_bytes();
}

struct Turns {
    VkDeviceAddress now;
    VkDeviceAddress previous;
};

Turns turns_shown(GroomMotion& groom, uint64_t frame) {
    // Without turns of the frame before there was no motion of this kind either.
    const bool continues = groom.shown_frame + 1 == frame || groom.shown_frame == frame;
    const uint32_t previous = continues ? groom.previous_slot : groom.slot;
    groom.shown_frame = frame;
    return {turns_of(groom, groom.slot), turns_of(groom, previous)};
}

MovePush move_push(const HairDeform& deform, const GroomMotion& groom, const Turns& turns) {
    return {.points = deform.points,
            .previous_points = deform.previous_points,
            .strand_begin = groom.buffers->strand_begin.address(),
            .parameters = deform.strands->parameters.address(),
            .follow = groom.buffers->follow.address(),
            .turns = turns.now,
            .previous_turns = turns.previous,
            .strand_count = deform.strands->strand_count,
            .links = groom.motion.guides().links};
}

MoveCardsPush cards_push(const HairDeform& deform, const GroomMotion& groom, const Turns& turns) {
    return {.points = deform.points,
            .previous_points = deform.previous_points,
            .card_begin = groom.buffers->strand_begin.address(),
            .row_begin = groom.buffers->row_begin.address(),
            .row_points = groom.buffers->row_points.address(),
            .parameters = deform.strands->parameters.address(),
            .follow = groom.buffers->follow.address(),
            .turns = turns.now,
            .previous_turns = turns.previous,
            .card_count = deform.strands->strand_count,
            .links = groom.motion.guides().links,
            .edge = groom.buffers->row_edge};
}

void add_push(const HairDeform& deform, GroomMotion& groom, uint64_t frame,
              HairMotionPasses& passes) {
    const Turns turns = turns_shown(groom, frame);
    if (groom.buffers->row_edge == 0) {
        passes.pushes.push_back(move_push(deform, groom, turns));
    } else {
        passes.card_pushes.push_back(cards_push(deform, groom, turns));
    }
}

bool make_pipelines(HairMotionPasses& passes, scene::RenderFrame& frame) {
    if (!passes.pushes.empty() && !frame.compute(passes.move, [] {
            return gpu::ComputeInfo{.shader = "hair/dynamics/move.comp.glsl",
                                    .push_bytes = sizeof(MovePush)};
        })) {
        return false;
    }
    return passes.card_pushes.empty() || frame.compute(passes.move_cards, [] {
        return gpu::ComputeInfo{.shader = "hair/dynamics/move_cards.comp.glsl",
                                .push_bytes = sizeof(MoveCardsPush)};
    });
}

/// The first time, guides go to the device as they are here.
bool add_solve(GroomMotion& groom, scene::RenderFrame& frame, HairMotionPasses& passes) {
    if (!groom.device) {
        auto made =
            DeviceGuides::upload(*frame.device, groom.motion.guides(), groom.motion.state());
        if (!made) {
            frame.fail(made.error());
            return false;
        }
        groom.device = *std::move(made);
    }
    passes.solves.push_back(groom.device->write(groom.slot, groom.motion.work(), groom.roots));
    return true;
}

graph::BufferHandle import_state(DeviceGuides& guides, scene::RenderFrame& frame) {
    return frame.graph.import_buffer("hair guide state", {guides.state.bytes()}, &guides.state,
                                     graph::Access::kStorageReadWrite,
                                     graph::Access::kStorageReadWrite);
}

bool describe_solve(HairMotionPasses& passes, scene::RenderFrame& frame) {
    if (!frame.compute(passes.solve, [] {
            return gpu::ComputeInfo{.shader = "hair/dynamics/solve.comp.glsl",
                                    .push_bytes = sizeof(SolvePush)};
        })) {
        return false;
    }
    auto pass = frame.graph.add_pass("hair/solve", graph::PassKind::kCompute);
    for (graph::BufferHandle& state : passes.states) {
        state = pass.write(state, graph::Access::kStorageReadWrite);
    }
    pass.execute([solves = std::span<const SolvePush>(passes.solves),
                  pipeline = passes.solve](graph::PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        for (const SolvePush& push : solves) {
            commands.push(push);
            commands.dispatch_threads(push.count, kStrandGroupSize);
        }
    });
    return true;
}

}  // namespace

void describe_hair_motion(Query<const HairMotion, const HairMoves> moving, Res<HairFrame> hair,
                          Res<HairMotions> motions, Res<HairMotionPasses> passes,
                          Res<const scene::FixedStep> step, Res<scene::RenderFrame> frame) {
    passes->pushes.clear();
    passes->card_pushes.clear();
    passes->solves.clear();
    passes->states.clear();
    for (const HairDeform& deform : hair->deforms) {
        const auto found = moving.get(deform.entity);
        if (!found || !std::get<1>(*found).now) continue;
        GroomMotion& groom = *motions->list[std::get<0>(*found).slot];
        if (groom.solve && !add_solve(groom, *frame, *passes)) return;
        if (groom.device) passes->states.push_back(import_state(*groom.device, *frame));
        add_push(deform, groom, step->frame, *passes);
    }
    const size_t moved = passes->pushes.size() + passes->card_pushes.size();
    if (moved == 0 || !hair->deformed || !make_pipelines(*passes, *frame)) return;
    passes->dispatches += moved + passes->solves.size();
    if (!passes->solves.empty() && !describe_solve(*passes, *frame)) return;
    auto pass = frame->graph.add_pass("hair/move", graph::PassKind::kCompute);
    for (const graph::BufferHandle state : passes->states) {
        pass.read(state, graph::Access::kStorageRead);
    }
    hair->deformed = pass.write(hair->deformed, graph::Access::kStorageReadWrite);
    pass.execute([pushes = std::span<const MovePush>(passes->pushes),
                  cards = std::span<const MoveCardsPush>(passes->card_pushes), move = passes->move,
                  move_cards = passes->move_cards](graph::PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        if (!pushes.empty()) commands.bind(*move);
        for (const MovePush& push : pushes) {
            commands.push(push);
            commands.dispatch_threads(push.strand_count, kStrandGroupSize);
        }
        if (!cards.empty()) commands.bind(*move_cards);
        for (const MoveCardsPush& push : cards) {
            commands.push(push);
            commands.dispatch_threads(push.card_count, kStrandGroupSize);
        }
    });
}

}  // namespace vellus::hair
