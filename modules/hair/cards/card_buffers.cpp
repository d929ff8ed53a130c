#include "modules/hair/cards/card_buffers.h"

#include <algorithm>

#include "modules/hair/cards/atlas_levels.h"
#include "modules/hair/cards/row_directions.h"

namespace vellus::hair {

namespace {

enum CardFlags : uint32_t { kRibbons = 1, kColors = 2, kParameters = 4, kApart = 8 };

/// Mirrors CardSet of shaders/hair/cards/cards.glsl.
struct CardSet {
    VkDeviceAddress uvs;
    VkDeviceAddress triangles;
    VkDeviceAddress parameters;
    VkDeviceAddress frames;
    VkDeviceAddress directions;
    VkDeviceAddress shape;
    VkDeviceAddress strand;
    VkDeviceAddress fibres;
    VkDeviceAddress color;
    glm::uvec2 size;
    uint32_t flags;
    float depth_range;
    uint32_t point_count;
    uint32_t triangle_count;
};
static_assert(sizeof(CardSet) == 96);

template <class T>
Result<void> upload_column(gpu::Device& device, const std::vector<T>& column, const char* name,
                           gpu::Buffer& out) {
    auto buffer = gpu::Buffer::upload_span(device, std::span(column), name);
    if (!buffer) return buffer.error();
    out = std::move(*buffer);
    return {};
}

/// Each triangle's points and its card.
std::vector<glm::uvec4> name_cards(const CardGroom& cards) {
    std::vector<glm::uvec4> named;
    named.reserve(cards.triangles.size());
    for (const glm::uvec3& t : cards.triangles) {
        const auto after = std::ranges::upper_bound(cards.card_begin, t.x);
        named.emplace_back(t, static_cast<uint32_t>(after - cards.card_begin.begin() - 1));
    }
    return named;
}

}  // namespace

Result<CardBuffers> CardBuffers::upload(gpu::Device& device, const CardGroom& cards,
                                        const gpu::Buffer& parameters) {
    CardBuffers buffers;
    AtlasLevels levels = make_levels(cards.atlas);
    // Read four at a time.
    levels.fibres.resize((levels.fibres.size() + 3) / 4 * 4);
    const Result<void> steps[] = {
        upload_column(device, cards.uvs, "card uvs", buffers.uvs),
        upload_column(device, name_cards(cards), "card triangles", buffers.triangles),
        upload_column(device, cards.frames, "card frames", buffers.frames),
        upload_column(device, row_directions(cards), "card row directions", buffers.directions),
        upload_column(device, levels.shape, "card shapes", buffers.shape),
        upload_column(device, levels.strand, "card strands", buffers.strand),
        upload_column(device, levels.fibres, "card fibres", buffers.fibres),
        upload_column(device, levels.color, "card colours", buffers.color),
    };
    for (const auto& step : steps) {
        if (!step) return step.error();
    }
    buffers.point_count = static_cast<uint32_t>(cards.points.size());
    buffers.triangle_count = static_cast<uint32_t>(cards.triangles.size());
    buffers.card_count = static_cast<uint32_t>(cards.card_count());
    buffers.ribbons = cards.ribbons;
    const Bounds bounds = bounds_of(cards);
    buffers.ball = glm::vec4(bounds.center(), 0.5f * glm::length(bounds.size()));
    const CardSet set{
        .uvs = buffers.uvs.address(),
        .triangles = buffers.triangles.address(),
        .parameters = parameters.address(),
        .frames = buffers.frames.address(),
        .directions = buffers.directions.address(),
        .shape = buffers.shape.address(),
        .strand = buffers.strand.address(),
        .fibres = buffers.fibres.address(),
        .color = buffers.color.address(),
        .size = {cards.atlas.width, cards.atlas.height},
        .flags = (cards.ribbons ? kRibbons : 0U) | (cards.atlas.color.empty() ? 0U : kColors) |
                 (cards.atlas.parameter.empty() ? 0U : kParameters) | (cards.ribbons ? 0U : kApart),
        .depth_range = cards.depth_range,
        .point_count = buffers.point_count,
        .triangle_count = buffers.triangle_count};
    auto uploaded = gpu::Buffer::upload_span(device, std::span(&set, 1), "card set");
    if (!uploaded) return uploaded.error();
    buffers.set = std::move(*uploaded);
    return buffers;
}

uint64_t CardBuffers::bytes() const {
    uint64_t sum = 0;
    for (const gpu::Buffer* buffer :
         {&uvs, &triangles, &frames, &directions, &shape, &strand, &fibres, &color, &set}) {
        sum += buffer->bytes();
    }
    return sum;
}

Result<StrandBuffers> upload_card_points(gpu::Device& device, const CardGroom& cards) {
    StrandBuffers buffers;
    if (auto done = upload_column(device, cards.points, "card points", buffers.positions); !done) {
        return done.error();
    }
    // Read two at a time.
    std::vector<uint16_t> parameters = cards.parameters;
    if (parameters.size() % 2 != 0) parameters.push_back(0);
    if (auto done = upload_column(device, parameters, "card parameters", buffers.parameters);
        !done) {
        return done.error();
    }
    buffers.point_count = static_cast<uint32_t>(cards.points.size());
    buffers.strand_count = static_cast<uint32_t>(cards.card_count());
    return buffers;
}

}  // namespace vellus::hair
