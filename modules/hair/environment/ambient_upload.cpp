#include "modules/hair/environment/ambient_upload.h"

#include <algorithm>
#include <span>

#include "modules/hair/cards/card_groom.h"
#include "modules/hair/environment/ambient_depth.h"

namespace vellus::hair {

namespace {

Result<void> upload(gpu::Device& device, float tip_scale, LibraryGroom& groom) {
    if (groom.positions.empty()) return {};
    const AmbientRoots roots{groom.positions, groom.strand_begin};
    const StrandTaper taper{groom.width > 0.0f ? groom.width : kNominalWidth, tip_scale};
    auto volume = std::make_shared<AmbientVolume>(
        groom.card_source ? ambient_volume(roots, card_pieces(*groom.card_source))
                          : ambient_volume(roots, taper));
    add_skin_below(roots, *volume);
    const auto packed = pack_ambient_depths(ambient_depths(*volume, roots.points));
    auto buffer = gpu::Buffer::upload_span(device, std::span(packed), "hair ambient depths");
    if (!buffer) return buffer.error();
    groom.strands.ambient = std::move(*buffer);
    groom.card_source.reset();
    groom.volume = std::move(volume);
    return {};
}

}  // namespace

void upload_ambient_depths(Res<HairLibrary> library, Res<HairFrame> hair,
                           Res<scene::RenderFrame> frame) {
    for (size_t i = 0; i < hair->draws.size(); ++i) {
        const HairDraw& draw = hair->draws[i];
        HairInstance& instance = hair->instances[i];
        if (draw.environment != EnvironmentTechnique::kShDepth || instance.ambient != 0) continue;
        const auto groom = std::ranges::find_if(
            library->grooms,
            [&](const LibraryGroom& candidate) { return &candidate.strands == draw.strands; });
        if (groom->strands.ambient.bytes() == 0) {
            if (auto done = upload(*frame->device, draw.tip_scale, *groom); !done) {
                return frame->fail(done.error());
            }
        }
        instance.ambient = groom->strands.ambient.address();
    }
}

}  // namespace vellus::hair
