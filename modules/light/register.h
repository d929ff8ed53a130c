#pragma once

#include "engine/ecs/ecs.h"

namespace vellus::light {

/// Resources (LightSet, ShadowSettings, Environment) and systems of the light module.
void register_light(World& world, Schedule& schedule);

}  // namespace vellus::light
