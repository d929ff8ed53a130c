#pragma once

#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/render_frame.h"

namespace vellus::hair {

/// Pipelines of technique `deep_opacity`, made when first needed.
struct DeepPipelines {
    const gpu::Pipeline* front = nullptr;
    const gpu::Pipeline* layers = nullptr;
    const gpu::Pipeline* card_layers = nullptr;
};

/// What casts into a light's layers: points and cards as that light sees them, and the closest
/// hair.
struct DeepSources {
    graph::BufferHandle depth;
    graph::BufferHandle points;         ///< invalid where nothing but cards casts
    graph::BufferHandle card_vertices;  ///< invalid without cards
};

/// Whether anything drawn looks its shadow up in layers; without, none of what follows is called.
bool wants_layers(const HairFrame& hair);

/// Memory for the layers of all lights that shadow hair, and their addresses into the LightSet.
Result<void> assign_layers(const HairFrame& hair, light::LightSet& lights, gpu::Device& device,
                           gpu::Buffer& memory);

/// Passes "hair/deep_front" and "hair/deep_layers" of light `index`; returns the new `layers`.
graph::BufferHandle describe_layers(const HairFrame& hair, const light::LightSet& lights,
                                    uint32_t index, const DeepSources& sources,
                                    DeepPipelines& pipelines, scene::RenderFrame& frame,
                                    graph::BufferHandle layers);

}  // namespace vellus::hair
