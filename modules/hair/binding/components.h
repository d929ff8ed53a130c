#pragma once

#include <cstdint>

#include "engine/ecs/entity.h"

namespace vellus::hair {

constexpr uint32_t kNoPose = ~0U;

/// Beside Hair: its roots lie on the skin of another entity's mesh. Given by bind_hair.
struct HairBinding {
    Entity mesh;
    uint32_t roots = 0;       ///< into HairBindings
    uint32_t pose = kNoPose;  ///< into this frame's HairPoses; kNoPose: the mesh is gone, the groom
                              ///< moves rigidly with its own node
};

/// Beside Hair: whether a later pass moves single points this frame (dynamics). Then the points of
/// this frame and the last lie in HairFrame::deformed even where no mesh carries the groom.
struct HairMoves {
    bool now = false;
};

}  // namespace vellus::hair
