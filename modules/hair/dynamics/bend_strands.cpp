#include "modules/hair/dynamics/bend_strands.h"

#include "shaders/common/portable.h"

namespace vellus::hair {

namespace glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)

/// The shader's transfer over turns in a column, guide by guide, link by link.
struct Transfer {
    std::vector<vec4> turns;
    uint links_per_guide = 0;

    [[nodiscard]] vec4 guide_turn(uint guide, uint link) const {
        return turns[size_t{guide} * links_per_guide + link];
    }
#include "hair/dynamics/transfer.glsl"
};
}  // namespace glsl

namespace {

glsl::Transfer transfer_of(const GroomMotion& groom) {
    const GuideSet& guides = groom.motion.guides();
    glsl::Transfer transfer{{}, guides.links};
    transfer.turns.reserve(size_t{guides.count} * guides.links);
    for (uint32_t g = 0; g < guides.count; ++g) {
        visit_link_turns(groom, g, [&](uint32_t, const glm::quat& turn) {
            transfer.turns.emplace_back(turn.x, turn.y, turn.z, turn.w);
        });
    }
    return transfer;
}

}  // namespace

void bend_strands(const GroomMotion& groom, std::span<const uint32_t> strand_begin,
                  std::span<const uint16_t> parameters, std::span<glm::dvec3> points) {
    if (groom.motion.guides().count == 0) return;
    glsl::Transfer transfer = transfer_of(groom);
    for (size_t strand = 0; strand + 1 < strand_begin.size(); ++strand) {
        const uint32_t first = strand_begin[strand];
        const StrandGuides& follow = groom.follow[strand];
        glm::dvec3 carried = points[first];
        glm::dvec3 point = carried;
        for (uint32_t i = first + 1; i < strand_begin[strand + 1]; ++i) {
            const float middle =
                0.5f * (static_cast<float>(parameters[i - 1]) + static_cast<float>(parameters[i])) /
                65535.0f;
            const glm::vec4 q = transfer.strand_turn(follow.guides, follow.weights, follow.reach,
                                                     middle, transfer.links_per_guide);
            const glm::dvec3 next = points[i];
            point += glm::dquat(q.w, q.x, q.y, q.z) * (next - carried);
            points[i] = point;
            carried = next;
        }
    }
}

}  // namespace vellus::hair
