#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "modules/scene/components.h"

namespace vellus::scene {

/// Translation · rotation · scale, in double.
glm::dmat4 to_matrix(const LocalTransform& transform);

/// Rows of the transform query, parents before children, and the columns worked on. Resource;
/// rebuilt when an entity or a parent changed, else reused without allocation.
struct Hierarchy {
    std::vector<Entity> entities;      ///< by row
    std::vector<Entity> parents;       ///< by row; kNoEntity for roots
    std::vector<uint32_t> parent_row;  ///< by row; its own row for roots
    std::vector<uint32_t> order;       ///< rows, by depth
    std::vector<uint32_t> levels;      ///< level i is order[levels[i], levels[i + 1])
    std::vector<glm::dmat4> world;     ///< by row
    uint64_t rebuilds = 0;
};

using TransformQuery =
    Query<Entity, const LocalTransform, const Parent*, WorldTransform, PreviousWorldTransform>;

/// System: world transforms of this frame and the last, linear in entities, levels in parallel.
/// Parents that are gone or form a cycle count as none (the cycle is logged once).
void propagate_transforms(TransformQuery query, Res<Hierarchy> hierarchy);

}  // namespace vellus::scene
