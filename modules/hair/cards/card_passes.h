#pragma once

#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/render_frame.h"

namespace vellus::hair {

/// Pipelines of the card passes, made when first needed.
struct CardPipelines {
    const gpu::Pipeline* project = nullptr;
    const gpu::Pipeline* visibility = nullptr;
    const gpu::Pipeline* visibility_still = nullptr;
    const gpu::Pipeline* shadow_depth = nullptr;
};

/// Bytes of a card's vertex as one view sees it (CardVertex of shaders/hair/cards/cards.glsl).
constexpr uint64_t kCardVertexBytes = 96;

// Each of these adds no pass where no cards are drawn, and returns the buffer it was given.

/// Pass "hair/cards_project": all vertices as the camera sees them, into HairFrame::card_vertices.
void describe_card_projection(HairFrame& hair, CardPipelines& pipelines, scene::RenderFrame& frame);

/// Pass "hair/cards_visibility": cards into the strands' visibility buffer.
graph::BufferHandle describe_card_visibility(const HairFrame& hair, CardPipelines& pipelines,
                                             scene::RenderFrame& frame, graph::BufferHandle target);

/// A light's map with cards in it, and their vertices as it sees them (invalid without cards).
struct CardShadow {
    graph::BufferHandle map;
    graph::BufferHandle vertices;
};

/// Passes "hair/cards_shadow_project" and "hair/cards_shadow_depth": cards into the map of light
/// `index`.
CardShadow describe_card_shadow(const HairFrame& hair, const light::LightSet& lights,
                                uint32_t index, CardPipelines& pipelines, scene::RenderFrame& frame,
                                graph::BufferHandle map);

/// Threads for each triangle of a groom that takes this many pixels: one for eight rows of them.
uint32_t threads_per_card_triangle(const CardBuffers& cards, glm::ivec2 pixels);
/// About how many pixels a groom takes of a picture; all where it reaches behind the eye.
glm::ivec2 card_pixels(const CardBuffers& cards, const glm::dmat4& to_clip, glm::ivec2 size);
constexpr uint32_t kTriangleGroupSize = 64;

}  // namespace vellus::hair
