#include "modules/hair/cards/add_cards.h"

#include "modules/hair/components.h"
#include "modules/hair/spawn.h"

namespace vellus::hair {

Result<uint32_t> add_cards(World& world, gpu::Device& device, const std::string& name,
                           const CardGroom& cards) {
    auto points = upload_card_points(device, cards);
    if (!points) return points.error();
    auto buffers = CardBuffers::upload(device, cards, points->parameters);
    if (!buffers) return buffers.error();
    auto& library = world.resource<HairLibrary>();
    library.grooms.push_back({.name = name,
                              .strands = std::move(*points),
                              .cards = std::move(*buffers),
                              .positions = cards.points,
                              .strand_begin = cards.card_begin,
                              .bounds = bounds_of(cards),
                              .outermost = outermost_points(cards.points),
                              .has_colors = !cards.atlas.color.empty()});
    return static_cast<uint32_t>(library.grooms.size() - 1);
}

}  // namespace vellus::hair
