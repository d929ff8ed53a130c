#include "engine/frame_graph/record.h"

#include <cstring>

#include "engine/frame_graph/access.h"
#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

/// NaN as a float, and large and odd as an integer.
constexpr uint32_t kPoisonWord = 0x7fc0dead;

VkImageAspectFlags aspect_of(const ImageDesc& desc) {
    return gpu::is_depth(desc.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkImageSubresourceRange subresources(const ImageDesc& desc, const ImageRange& range) {
    return {aspect_of(desc), range.mip, range.mips, range.layer, range.layers};
}

ImageRange whole(const ImageDesc& desc) {
    return {0, static_cast<uint16_t>(desc.mips), 0, static_cast<uint16_t>(desc.layers)};
}

void fill_image(VkCommandBuffer commands, VkImage image, const ImageDesc& desc, uint32_t word,
                float depth) {
    const VkImageSubresourceRange range = subresources(desc, whole(desc));
    if (gpu::is_depth(desc.format)) {
        const VkClearDepthStencilValue value{.depth = depth};
        vkCmdClearDepthStencilImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value,
                                    1, &range);
        return;
    }
    const VkClearColorValue value{.uint32 = {word, word, word, word}};
    vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
}

}  // namespace

/// The passes' window on the frame: only what the pass declared.
class Recorder::Context final : public PassContext {
  public:
    Context(Recorder& recorder, gpu::CommandBuffer& commands, uint32_t pass)
        : recorder_(recorder), in_(recorder.in_), commands_(commands), pass_(pass) {}

    gpu::CommandBuffer& commands() override { return commands_; }
    VkImage image(ImageHandle image) override {
        return declared(image) ? physical(image).image : in_.placeholder.image;
    }
    VkImageView view(ImageHandle image) override {
        const AccessRecord* access = declared(image);
        return access ? recorder_.view(image.index, access->range) : in_.placeholder.whole;
    }
    VkImageView view(ImageHandle image, ImageRange range) override {
        if (!declared(image)) return in_.placeholder.whole;
        const ImageDesc& d = recorder_.record(image.index).image;
        if (range.mips == ImageRange::kAll) range.mips = static_cast<uint16_t>(d.mips - range.mip);
        if (range.layers == ImageRange::kAll) {
            range.layers = static_cast<uint16_t>(d.layers - range.layer);
        }
        return recorder_.view(image.index, range);
    }
    VkBuffer buffer(BufferHandle buffer) override {
        return declared(buffer) ? physical(buffer).buffer : in_.placeholder.buffer;
    }
    VkDeviceAddress address(BufferHandle buffer) override {
        return declared(buffer) ? physical(buffer).address : in_.placeholder.address;
    }
    bool history_valid(ImageHandle previous) override {
        return declared(previous) && physical(previous).history_valid;
    }
    const ImageDesc& desc(ImageHandle image) override {
        static constexpr ImageDesc kNothing{gpu::Format::kRgba8Unorm, 1, 1};
        return declared(image) ? recorder_.record(image.index).image : kNothing;
    }
    [[nodiscard]] uint64_t frame() const override { return in_.frame - 1; }

  private:
    /// How the pass declared this version, or else another one of the resource.
    const AccessRecord* declared(Handle handle) {
        const AccessRecord* found = nullptr;
        if (handle.generation == in_.graph->generation()) {
            for (const AccessRecord& access : in_.graph->accesses(pass_)) {
                if (access.resource != handle.index) continue;
                if (!found || access.version == handle.version) found = &access;
            }
        }
        if (!found) {
            const bool known = handle.generation == in_.graph->generation() &&
                               handle.index < in_.graph->resources().size();
            in_.diagnostics->push_back({Problem::kUndeclaredAccess, pass_,
                                        known ? handle.index : kNoIndex, kNoIndex,
                                        in_.graph->passes()[pass_].where});
        }
        return found;
    }
    Physical& physical(Handle handle) { return (*in_.physical)[handle.index]; }

    Recorder& recorder_;
    const RecordInput& in_;
    gpu::CommandBuffer& commands_;
    uint32_t pass_;
};

VkImageView Recorder::view(uint32_t resource, const ImageRange& range) {
    Physical& physical = (*in_.physical)[resource];
    const ImageDesc& desc = record(resource).image;
    if (physical.whole && range == whole(desc)) return physical.whole;
    // Imported images may come and go under one handle, so views of their parts live for a frame.
    one_view_.clear();
    auto& views = physical.views ? *physical.views : one_view_;
    const auto made =
        view_of(*in_.device, desc, physical.image, range, views, *in_.graveyard, *in_.created);
    if (!made) {
        failure_ = VK_ERROR_OUT_OF_HOST_MEMORY;
        return VK_NULL_HANDLE;
    }
    if (!physical.views) in_.graveyard->add({.frame = in_.frame, .view = *made});
    return *made;
}

void Recorder::barriers(VkCommandBuffer commands, std::span<const Barrier> batch) {
    if (batch.empty()) return;
    memory_barriers_.clear();
    buffer_barriers_.clear();
    image_barriers_.clear();
    for (const Barrier& b : batch) {
        if (b.global) {
            memory_barriers_.push_back({.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                        .srcStageMask = b.src_stages,
                                        .srcAccessMask = b.src_access,
                                        .dstStageMask = b.dst_stages,
                                        .dstAccessMask = b.dst_access});
        } else if (record(b.resource).kind == ResourceKind::kBuffer) {
            buffer_barriers_.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                                        .srcStageMask = b.src_stages,
                                        .srcAccessMask = b.src_access,
                                        .dstStageMask = b.dst_stages,
                                        .dstAccessMask = b.dst_access,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .buffer = (*in_.physical)[b.resource].buffer,
                                        .size = VK_WHOLE_SIZE});
        } else {
            image_barriers_.push_back(
                {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                 .srcStageMask = b.src_stages,
                 .srcAccessMask = b.src_access,
                 .dstStageMask = b.dst_stages,
                 .dstAccessMask = b.dst_access,
                 .oldLayout = b.old_layout,
                 .newLayout = b.new_layout,
                 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                 .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                 .image = (*in_.physical)[b.resource].image,
                 .subresourceRange = subresources(record(b.resource).image, b.range)});
        }
    }
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = static_cast<uint32_t>(memory_barriers_.size()),
        .pMemoryBarriers = memory_barriers_.data(),
        .bufferMemoryBarrierCount = static_cast<uint32_t>(buffer_barriers_.size()),
        .pBufferMemoryBarriers = buffer_barriers_.data(),
        .imageMemoryBarrierCount = static_cast<uint32_t>(image_barriers_.size()),
        .pImageMemoryBarriers = image_barriers_.data()};
    vkCmdPipelineBarrier2(commands, &dependency);
}

void Recorder::clear_history(VkCommandBuffer commands, std::span<const uint32_t> resources) {
    for (const uint32_t resource : resources) {
        const ImageDesc& desc = record(resource).image;
        Barrier barrier{.resource = resource,
                        .src_stages = kAllStages,
                        .src_access = VK_ACCESS_MEMORY_WRITE_BIT,
                        .dst_stages = VK_PIPELINE_STAGE_TRANSFER_BIT,
                        .dst_access = VK_ACCESS_TRANSFER_WRITE_BIT,
                        .old_layout = VK_IMAGE_LAYOUT_UNDEFINED,
                        .new_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                        .range = whole(desc)};
        barriers(commands, {&barrier, 1});
        fill_image(commands, (*in_.physical)[resource].image, desc, 0, 0);
        barrier.old_layout = barrier.new_layout;
        barrier.new_layout = kHistoryLayout;
        barrier.src_stages = kAllStages;
        barrier.dst_stages = kAllStages;
        barrier.dst_access = kAllAccess;
        barriers(commands, {&barrier, 1});
    }
}

void Recorder::poison(VkCommandBuffer commands, uint32_t resource) {
    const Physical& physical = (*in_.physical)[resource];
    if (record(resource).kind == ResourceKind::kBuffer) {
        vkCmdFillBuffer(commands, physical.buffer, 0, VK_WHOLE_SIZE, kPoisonWord);
    } else {
        fill_image(commands, physical.image, record(resource).image, kPoisonWord, 0.375F);
    }
}

VkRenderingAttachmentInfo Recorder::attachment_info(const Attachment& attachment) {
    VkRenderingAttachmentInfo out{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                  .imageView = view(attachment.resource, attachment.range),
                                  .imageLayout = attachment.layout,
                                  .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                  .storeOp = attachment.store ? VK_ATTACHMENT_STORE_OP_STORE
                                                              : VK_ATTACHMENT_STORE_OP_DONT_CARE};
    if (attachment.read_only) out.storeOp = VK_ATTACHMENT_STORE_OP_NONE;
    if (attachment.load.op == Load::kDiscard) out.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    if (attachment.load.op == Load::kClear) {
        out.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        std::memcpy(&out.clearValue, attachment.load.bits.data(), sizeof(attachment.load.bits));
    }
    return out;
}

void Recorder::begin_rendering(VkCommandBuffer commands, const Step& step) {
    std::array<VkRenderingAttachmentInfo, 9> infos;
    const uint32_t count = step.color_count + (step.has_depth ? 1 : 0);
    VkExtent2D extent{};
    uint32_t layers = 1;
    for (uint32_t i = 0; i < count; ++i) {
        const Attachment& attachment = in_.plan->attachments[step.first_attachment + i];
        infos[i] = attachment_info(attachment);
        const ImageDesc& desc = record(attachment.resource).image;
        extent = {std::max(desc.width >> attachment.range.mip, 1U),
                  std::max(desc.height >> attachment.range.mip, 1U)};
        layers = attachment.range.layers;
    }
    const VkRenderingInfo rendering{
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = {{0, 0}, extent},
        .layerCount = layers,
        .colorAttachmentCount = step.color_count,
        .pColorAttachments = infos.data(),
        .pDepthAttachment = step.has_depth ? &infos[step.color_count] : nullptr};
    vkCmdBeginRendering(commands, &rendering);
    const VkViewport viewport{
        0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
}

void Recorder::pass(gpu::CommandBuffer& commands, const Step& step) {
    const PassRecord& pass = in_.graph->passes()[step.index];
    const bool raster = pass.kind == PassKind::kRaster;
    if (raster) begin_rendering(commands.handle(), step);
    if (pass.record) {
        Context context(*this, commands, step.index);
        pass.record(pass.closure, context);
    }
    if (raster) vkCmdEndRendering(commands.handle());
}

}  // namespace vellus::graph
