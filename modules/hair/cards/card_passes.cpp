#include "modules/hair/cards/card_passes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "engine/frame_graph/context.h"

namespace vellus::hair {

namespace {

using graph::Access;
using graph::PassContext;
using graph::PassKind;

constexpr uint32_t kProjectGroupSize = 64;

/// Push constants of shaders/hair/cards/project.comp.glsl.
struct CardProjectPush {
    glm::mat4 to_clip;
    glm::vec4 eye;
    VkDeviceAddress cards;
    VkDeviceAddress points;
    VkDeviceAddress target;
    glm::vec2 viewport;
};
static_assert(sizeof(CardProjectPush) == 112);

/// Push constants of shaders/hair/cards/visibility.comp.glsl.
struct CardVisibilityPush {
    VkDeviceAddress cards;
    VkDeviceAddress vertices;
    VkDeviceAddress target;
    glm::ivec2 size;
    uint32_t first_id;
    uint32_t frame;
    float alpha;
    uint32_t threads;
    uint32_t triangle_count;
    uint32_t padding = 0;
};
static_assert(sizeof(CardVisibilityPush) == 56);

/// Push constants of shaders/hair/cards/shadow_depth.comp.glsl.
struct CardShadowPush {
    VkDeviceAddress cards;
    VkDeviceAddress vertices;
    VkDeviceAddress target;
    glm::ivec2 size;
    float alpha;
    uint32_t threads;
    uint32_t triangle_count;
    uint32_t padding = 0;
};
static_assert(sizeof(CardShadowPush) == 48);

gpu::ComputeInfo info(const char* shader, uint32_t push_bytes,
                      std::vector<uint32_t> constants = {}) {
    return {.shader = shader, .push_bytes = push_bytes, .constants = std::move(constants)};
}

bool any_cards(const std::vector<HairDraw>& draws) {
    return std::ranges::any_of(draws, [](const HairDraw& draw) { return draw.cards != nullptr; });
}

/// The eye in the space that `to_clip` takes to clip space: a position (w = 1), or the direction
/// towards it of a parallel projection (w = 0). It is what projects to (0, 0, 1, 0), for depth is
/// reversed.
glm::vec4 eye_of(const glm::dmat4& to_clip) {
    const glm::dvec4 eye = glm::inverse(to_clip) * glm::dvec4(0, 0, 1, 0);
    const double length = glm::length(glm::dvec3(eye));
    const bool parallel = std::abs(eye.w) <= 1e-9 * length;
    return parallel ? glm::vec4(glm::dvec3(eye) / length, 0.0) : glm::vec4(eye / eye.w);
}

CardProjectPush project_push(const HairDraw& draw, const glm::dmat4& to_clip, glm::vec2 viewport) {
    return {.to_clip = glm::mat4(to_clip),
            .eye = eye_of(to_clip),
            .cards = draw.cards->set.address(),
            .points = draw.positions,
            .target = 0,
            .viewport = viewport};
}

uint32_t project_threads(const CardBuffers& cards) {
    return cards.ribbons ? cards.point_count / 3 : cards.point_count;
}

bool make_projection(CardPipelines& pipelines, scene::RenderFrame& frame) {
    return frame.compute(pipelines.project, [] {
        return info("hair/cards/project.comp.glsl", sizeof(CardProjectPush));
    });
}

}  // namespace

uint32_t threads_per_card_triangle(const CardBuffers& cards, glm::ivec2 pixels) {
    const uint32_t rows = std::max(cards.triangle_count / std::max(2 * cards.card_count, 1U), 1U);
    const int height = std::max(pixels.x, pixels.y) / static_cast<int>(rows);
    return std::clamp(std::bit_ceil(static_cast<uint32_t>(height / 8)), 1U, 32U);
}

glm::ivec2 card_pixels(const CardBuffers& cards, const glm::dmat4& to_clip, glm::ivec2 size) {
    const glm::dvec4 center = to_clip * glm::dvec4(glm::dvec3(cards.ball), 1.0);
    const glm::dmat4 rows = glm::transpose(to_clip);
    const auto radius = static_cast<double>(cards.ball.w);
    const double nearest = center.w - radius * glm::length(glm::dvec3(rows[3]));
    if (nearest <= 0.0) return size;
    const glm::dvec2 across =
        radius / nearest *
        glm::dvec2(glm::length(glm::dvec3(rows[0])), glm::length(glm::dvec3(rows[1])));
    return glm::ivec2(glm::min(across, glm::dvec2(1.0)) * glm::dvec2(size));
}

void describe_card_projection(HairFrame& hair, CardPipelines& pipelines,
                              scene::RenderFrame& frame) {
    if (!any_cards(hair.draws) || !make_projection(pipelines, frame)) return;
    hair.card_vertices =
        frame.graph.create_buffer("hair card vertices", {hair.card_points * kCardVertexBytes});
    auto pass = frame.graph.add_pass("hair/cards_project", PassKind::kCompute);
    if (hair.deformed) pass.read(hair.deformed, Access::kStorageRead);
    hair.card_vertices =
        pass.write(hair.card_vertices, Access::kStorageWrite, graph::Load::kDiscard);
    pass.execute([draws = std::span<const HairDraw>(hair.draws), target = hair.card_vertices,
                  viewport = glm::vec2(frame.size),
                  pipeline = pipelines.project](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        for (const HairDraw& draw : draws) {
            if (draw.cards == nullptr) continue;
            CardProjectPush push = project_push(draw, glm::dmat4(draw.to_clip), viewport);
            push.target = context.address(target) + draw.first_card_point * kCardVertexBytes;
            commands.push(push);
            commands.dispatch_threads(project_threads(*draw.cards), kProjectGroupSize);
        }
    });
}

graph::BufferHandle describe_card_visibility(const HairFrame& hair, CardPipelines& pipelines,
                                             scene::RenderFrame& frame,
                                             graph::BufferHandle target) {
    if (!any_cards(hair.draws) || !hair.card_vertices) return target;
    for (const HairDraw& draw : hair.draws) {
        if (draw.cards == nullptr) continue;
        const bool moving = draw.opacity == OpacityTechnique::kDither;
        if (!frame.compute(moving ? pipelines.visibility : pipelines.visibility_still, [&] {
                return info("hair/cards/visibility.comp.glsl", sizeof(CardVisibilityPush),
                            {moving ? 0U : 1U});
            })) {
            return target;
        }
    }
    auto pass = frame.graph.add_pass("hair/cards_visibility", PassKind::kCompute);
    pass.read(hair.card_vertices, Access::kStorageRead);
    target = pass.write(target, Access::kStorageReadWrite);
    pass.execute([draws = std::span<const HairDraw>(hair.draws), vertices = hair.card_vertices,
                  target, size = glm::ivec2(frame.size), index = frame.frame_index,
                  moving = pipelines.visibility,
                  still = pipelines.visibility_still](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        for (const HairDraw& draw : draws) {
            if (draw.cards == nullptr) continue;
            commands.bind(draw.opacity == OpacityTechnique::kDither ? *moving : *still);
            const uint32_t threads =
                threads_per_card_triangle(*draw.cards, draw.rect.end - draw.rect.first);
            commands.push(CardVisibilityPush{
                .cards = draw.cards->set.address(),
                .vertices = context.address(vertices) + draw.first_card_point * kCardVertexBytes,
                .target = context.address(target),
                .size = size,
                .first_id = draw.first_id,
                .frame = index,
                .alpha = draw.alpha,
                .threads = threads,
                .triangle_count = draw.cards->triangle_count});
            commands.dispatch_threads(draw.cards->triangle_count * threads, kTriangleGroupSize);
        }
    });
    return target;
}

CardShadow describe_card_shadow(const HairFrame& hair, const light::LightSet& lights,
                                uint32_t index, CardPipelines& pipelines, scene::RenderFrame& frame,
                                graph::BufferHandle map) {
    if (!any_cards(hair.casters) || !make_projection(pipelines, frame) ||
        !frame.compute(pipelines.shadow_depth, [] {
            return info("hair/cards/shadow_depth.comp.glsl", sizeof(CardShadowPush));
        })) {
        return {map, {}};
    }
    uint64_t points = 0;
    for (const HairDraw& draw : hair.casters) {
        if (draw.cards != nullptr) points += draw.cards->point_count;
    }
    const light::PunctualLight& light = lights.block.light[index];
    auto vertices =
        frame.graph.create_buffer("hair card light vertices", {points * kCardVertexBytes});
    auto project = frame.graph.add_pass("hair/cards_shadow_project", PassKind::kCompute);
    if (hair.deformed) project.read(hair.deformed, Access::kStorageRead);
    vertices = project.write(vertices, Access::kStorageWrite, graph::Load::kDiscard);
    project.execute([casters = std::span<const HairDraw>(hair.casters), vertices,
                     to_hair = lights.world_to_hair[index], size = light.hair_size,
                     pipeline = pipelines.project](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        VkDeviceAddress target = context.address(vertices);
        for (const HairDraw& draw : casters) {
            if (draw.cards == nullptr) continue;
            CardProjectPush push = project_push(draw, to_hair * draw.world, glm::vec2(size));
            push.target = target;
            commands.push(push);
            commands.dispatch_threads(project_threads(*draw.cards), kProjectGroupSize);
            target += draw.cards->point_count * kCardVertexBytes;
        }
    });
    auto pass = frame.graph.add_pass("hair/cards_shadow_depth", PassKind::kCompute);
    pass.read(vertices, Access::kStorageRead);
    map = pass.write(map, Access::kStorageReadWrite);
    pass.execute([casters = std::span<const HairDraw>(hair.casters), vertices,
                  target = light.hair_depth, size = light.hair_size,
                  to_hair = lights.world_to_hair[index],
                  pipeline = pipelines.shadow_depth](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        VkDeviceAddress source = context.address(vertices);
        for (const HairDraw& draw : casters) {
            if (draw.cards == nullptr) continue;
            const uint32_t threads = threads_per_card_triangle(
                *draw.cards, card_pixels(*draw.cards, to_hair * draw.world, glm::ivec2(size)));
            commands.push(CardShadowPush{.cards = draw.cards->set.address(),
                                         .vertices = source,
                                         .target = target,
                                         .size = glm::ivec2(size),
                                         .alpha = draw.alpha,
                                         .threads = threads,
                                         .triangle_count = draw.cards->triangle_count});
            commands.dispatch_threads(draw.cards->triangle_count * threads, kTriangleGroupSize);
            source += draw.cards->point_count * kCardVertexBytes;
        }
    });
    return {map, vertices};
}

}  // namespace vellus::hair
