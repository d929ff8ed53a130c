#pragma once

#include "engine/ecs/ecs.h"
#include "engine/gpu/device.h"
#include "modules/hair/cards/card_groom.h"

namespace vellus::hair {

/// Cards that are in node space and metres into the world's HairLibrary; worn by entities like any
/// groom.
Result<uint32_t> add_cards(World& world, gpu::Device& device, const std::string& name,
                           const CardGroom& cards);

}  // namespace vellus::hair
