#pragma once

#include <string_view>

#include "engine/ecs/ecs.h"
#include "engine/platform/result.h"
#include "game_demo/src/accuracy/budget.h"

namespace vellus::demo {

/// Puts "NAME=VALUE" into effect; empty changes nothing. `detail` (share of the strands),
/// `roughness` and `falloff` (1/m, behind the closest hair) belong to one hair entity, `map`
/// (texels along a shadow map) and `taa` (on, off) to the world. An Error lists them.
Result<void> apply_setting(World& world, Entity hair, std::string_view setting);

/// Technique and setting of one axis for one hair entity.
Result<void> apply_choice(World& world, Entity hair, const AxisChoice& choice);

}  // namespace vellus::demo
