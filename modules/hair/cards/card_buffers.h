#pragma once

#include "engine/gpu/buffer.h"
#include "modules/hair/cards/card_groom.h"
#include "modules/hair/geometry/strand_buffers.h"

namespace vellus::hair {

/// Columns of a card groom on the device but its points, which lie with the strands' columns so
/// that what moves strands moves cards (see upload_card_points). Empty for strands.
struct CardBuffers {
    gpu::Buffer uvs;
    gpu::Buffer triangles;
    gpu::Buffer frames;
    gpu::Buffer directions;  ///< row_directions() of ribbons
    gpu::Buffer shape;
    gpu::Buffer strand;
    gpu::Buffer fibres;
    gpu::Buffer color;
    gpu::Buffer set;  ///< CardSet of shaders/hair/cards/cards.glsl
    uint32_t point_count = 0;
    uint32_t triangle_count = 0;
    uint32_t card_count = 0;
    bool ribbons = false;
    glm::vec4 ball{0.0f};  ///< around all cards, groom space: centre and radius

    /// `parameters` is where upload_card_points put them. Errors name the column that did not fit.
    static Result<CardBuffers> upload(gpu::Device& device, const CardGroom& cards,
                                      const gpu::Buffer& parameters);
    [[nodiscard]] uint64_t bytes() const;
    explicit operator bool() const { return triangle_count > 0; }
};

/// The points of cards as strands without segments: a card is a strand, its points follow each
/// other.
Result<StrandBuffers> upload_card_points(gpu::Device& device, const CardGroom& cards);

}  // namespace vellus::hair
