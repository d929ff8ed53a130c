#pragma once

#include <memory>
#include <vector>

#include "engine/gpu/image.h"
#include "engine/gpu/upload_ring.h"
#include "modules/scene/render_frame.h"

struct ImDrawData;

namespace vellus::demo {

/// Dear ImGui's draw lists as one pass over the finished picture.
class PanelPass {
  public:
    /// Uploads the glyphs of the current ImGui context.
    static Result<std::unique_ptr<PanelPass>> create(gpu::Device& device);

    /// Adds pass "demo/panels" to the frame, nothing where `data` is empty.
    void describe(const ImDrawData& data, scene::RenderFrame& frame);

  private:
    struct Vertex {
        float position[2];
        float texcoord[2];
        uint32_t color;
    };
    /// Triangles inside one rectangle of the picture.
    struct Batch {
        uint32_t first_index;
        uint32_t index_count;
        VkRect2D clip;
    };

    void collect(const ImDrawData& data, glm::uvec2 size);

    gpu::Image glyphs_;
    gpu::UploadRing uploads_;
    const gpu::Pipeline* pipeline_ = nullptr;
    std::vector<Vertex> vertices_;
    std::vector<uint32_t> indices_;
    std::vector<Batch> batches_;
};

}  // namespace vellus::demo
