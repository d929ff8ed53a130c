#include "game_demo/src/panels/panel_pass.h"

#include <imgui.h>

#include <algorithm>

#include "engine/frame_graph/context.h"

namespace vellus::demo {

namespace {

constexpr uint64_t kUploadBytes = uint64_t{4}
                                  << 20;  ///< a frame; a full screen of text takes 1 MiB

struct PanelPush {
    VkDeviceAddress vertices;
    VkDeviceAddress indices;
    glm::vec2 to_clip;
};

gpu::RasterInfo panel_pipeline() {
    return {.vertex_shader = "demo/panel.vert.glsl",
            .fragment_shader = "demo/panel.frag.glsl",
            .bindings = {gpu::Binding::kSampledLinear},
            .push_bytes = sizeof(PanelPush),
            .color_formats = {gpu::Format::kRgba8Unorm},
            .blend = true};
}

/// The part of ImGui's rectangle (x0, y0, x1, y1) that lies in the picture.
VkRect2D clip_rectangle(const ImVec4& box, glm::uvec2 size) {
    const glm::ivec2 low = glm::max(glm::ivec2(box.x, box.y), glm::ivec2(0));
    const glm::ivec2 high = glm::min(glm::ivec2(box.z, box.w), glm::ivec2(size));
    const glm::uvec2 extent(glm::max(high - low, glm::ivec2(0)));
    return {{low.x, low.y}, {extent.x, extent.y}};
}

}  // namespace

Result<std::unique_ptr<PanelPass>> PanelPass::create(gpu::Device& device) {
    auto pass = std::make_unique<PanelPass>();
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    // The engine has no one-channel byte format; half a megabyte once does not justify one.
    std::vector<uint8_t> rgba(size_t{4} * width * height);
    for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = pixels[i / 4];
    auto glyphs = gpu::Image::upload(device,
                                     {.format = gpu::Format::kRgba8Unorm,
                                      .width = static_cast<uint32_t>(width),
                                      .height = static_cast<uint32_t>(height)},
                                     std::as_bytes(std::span(rgba)), "panel glyphs");
    if (!glyphs) return glyphs.error();
    pass->glyphs_ = std::move(*glyphs);
    auto uploads = gpu::UploadRing::create(device, kUploadBytes, scene::kFramesInFlight);
    if (!uploads) return uploads.error();
    pass->uploads_ = std::move(*uploads);
    return pass;
}

void PanelPass::collect(const ImDrawData& data, glm::uvec2 size) {
    vertices_.clear();
    indices_.clear();
    batches_.clear();
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        const auto base = static_cast<uint32_t>(vertices_.size());
        const auto first = static_cast<uint32_t>(indices_.size());
        for (const ImDrawVert& v : list.VtxBuffer) {
            vertices_.push_back({{v.pos.x, v.pos.y}, {v.uv.x, v.uv.y}, v.col});
        }
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const VkRect2D clip = clip_rectangle(command.ClipRect, size);
            if (clip.extent.width == 0 || clip.extent.height == 0) continue;
            batches_.push_back({first + command.IdxOffset, command.ElemCount, clip});
        }
        for (const ImDrawIdx index : list.IdxBuffer) indices_.push_back(base + index);
    }
}

void PanelPass::describe(const ImDrawData& data, scene::RenderFrame& frame) {
    if (!frame.raster(pipeline_, panel_pipeline)) return;
    collect(data, frame.size);
    uploads_.begin_frame();
    if (batches_.empty()) return;
    const PanelPush push{uploads_.push_span(std::span<const Vertex>(vertices_)),
                         uploads_.push_span(std::span<const uint32_t>(indices_)),
                         2.0f / glm::vec2(frame.size)};
    if (push.vertices == 0 || push.indices == 0) return;
    auto pass = frame.graph.add_pass("demo/panels", graph::PassKind::kRaster);
    frame.display = pass.color(frame.display);
    pass.execute([push, batches = std::span<const Batch>(batches_), pipeline = pipeline_,
                  glyphs = glyphs_.view()](graph::PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        commands.images({glyphs});
        commands.push(push);
        for (const Batch& batch : batches) {
            vkCmdSetScissor(commands.handle(), 0, 1, &batch.clip);
            commands.draw(batch.index_count, 1, batch.first_index);
        }
    });
}

}  // namespace vellus::demo
