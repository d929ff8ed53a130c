#pragma once

#include <filesystem>

#include "engine/ecs/ecs.h"
#include "engine/gpu/device.h"
#include "modules/hair/cards/card_groom.h"
#include "modules/hair/groom/hair_extension.h"

namespace vellus::hair {

/// Cards that are in node space and metres into the world's HairLibrary; worn by entities like any
/// groom.
Result<uint32_t> add_cards(World& world, gpu::Device& device, const std::string& name,
                           const CardGroom& cards);

/// Cards built from a file's strands as `look.cards` (which must be there) and `look.width` say;
/// the same request is built once, and logged.
Result<uint32_t> add_built_cards(World& world, gpu::Device& device,
                                 const std::filesystem::path& path, const HairExtension& look);

}  // namespace vellus::hair
