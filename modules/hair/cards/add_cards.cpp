#include "modules/hair/cards/add_cards.h"

#include <cmath>

#include "engine/platform/log.h"
#include "modules/hair/cards/build_cards.h"
#include "modules/hair/components.h"
#include "modules/hair/groom/load_strands.h"
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
                              .card_parameters = cards.parameters,
                              .card_source = std::make_shared<const CardGroom>(cards),
                              .bounds = bounds_of(cards),
                              .outermost = outermost_points(cards.points),
                              .has_colors = !cards.atlas.color.empty(),
                              .color = cards.color,
                              .mean_color = mean_color(cards)});
    return static_cast<uint32_t>(library.grooms.size() - 1);
}

Result<uint32_t> add_built_cards(World& world, gpu::Device& device,
                                 const std::filesystem::path& path, const HairExtension& look) {
    const CardsChoice& choice = *look.cards;
    // The look is in metres; the groom may be in centimetres that the transform scales.
    const auto unit = static_cast<float>(std::cbrt(look.scale.x * look.scale.y * look.scale.z));
    const std::string name =
        fmt::format("{} ({} cards, {} texels per metre, {} texels, widths {} {}, unit {})",
                    strands_name(path, look.upright), choice.count, choice.texels_per_metre,
                    choice.max_texels, look.width.root, look.width.tip_scale, unit);
    if (const auto known = find_groom(world, name)) return *known;
    auto loaded = load_strands(path, look.upright);
    if (!loaded) return loaded.error();
    StrandData& strands = loaded->strands;
    if (look.width.root > 0.0f) {
        strands.width = look.width.root / unit;
        strands.point_width.clear();
    }
    auto built = build_cards(strands, {.cards = choice.count,
                                       .texels_per_metre = choice.texels_per_metre * unit,
                                       .max_texels = choice.max_texels,
                                       .tolerance = CardBuildOptions{}.tolerance / unit,
                                       .tip_scale = look.width.tip_scale});
    if (!built) return Error{built.error().what, path.string(), built.error().remedy};
    log_info("{}: {}", path.filename().string(), to_text(built->report));
    auto groom = add_cards(world, device, name, built->cards);
    if (!groom) return groom;
    world.resource<HairLibrary>().grooms[*groom].report = loaded->report;
    return groom;
}

}  // namespace vellus::hair
