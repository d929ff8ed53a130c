#pragma once

#include <vector>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "engine/gpu/pipeline_library.h"
#include "modules/hair/binding/components.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/render_frame.h"
#include "modules/scene/time.h"

namespace vellus::hair {

/// Push constants of shaders/hair/dynamics/move.comp.glsl.
struct MovePush {
    VkDeviceAddress points;
    VkDeviceAddress previous_points;
    VkDeviceAddress strand_begin;
    VkDeviceAddress parameters;
    VkDeviceAddress follow;
    VkDeviceAddress turns;
    VkDeviceAddress previous_turns;
    uint32_t strand_count;
    uint32_t links;
};
static_assert(sizeof(MovePush) == 64);

/// Push constants of shaders/hair/dynamics/move_cards.comp.glsl.
struct MoveCardsPush {
    VkDeviceAddress points;
    VkDeviceAddress previous_points;
    VkDeviceAddress card_begin;
    VkDeviceAddress row_begin;
    VkDeviceAddress row_points;
    VkDeviceAddress parameters;
    VkDeviceAddress follow;
    VkDeviceAddress turns;
    VkDeviceAddress previous_turns;
    uint32_t card_count;
    uint32_t links;
    uint32_t edge;
    uint32_t padding = 0;
};
static_assert(sizeof(MoveCardsPush) == 88);

/// Pipelines and dispatches of moving hair; made when hair first moves. Resource.
struct HairMotionPasses {
    const gpu::Pipeline* move = nullptr;
    const gpu::Pipeline* move_cards = nullptr;
    const gpu::Pipeline* solve = nullptr;
    std::vector<MovePush> pushes;             ///< of this frame
    std::vector<MoveCardsPush> card_pushes;   ///< the same
    std::vector<SolvePush> solves;            ///< the same
    std::vector<graph::BufferHandle> states;  ///< of grooms the device solves, this frame
    uint64_t dispatches = 0;                  ///< so far, of either
};

/// System, stage strands, between deformation and projection: pass "hair/solve" where the device is
/// to solve guides, then "hair/move", strands and cards after their guides; none where nothing
/// moves.
void describe_hair_motion(Query<const HairMotion, const HairMoves> moving, Res<HairFrame> hair,
                          Res<HairMotions> motions, Res<HairMotionPasses> passes,
                          Res<const scene::FixedStep> step, Res<scene::RenderFrame> frame);

}  // namespace vellus::hair
