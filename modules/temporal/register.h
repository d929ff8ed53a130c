#pragma once

#include "engine/ecs/ecs.h"

namespace vellus::temporal {

/// Resources (TemporalSettings) and systems of the temporal module; needs the scene module.
void register_temporal(World& world, Schedule& schedule);

}  // namespace vellus::temporal
