#pragma once

#include <cstring>
#include <initializer_list>
#include <span>

#include "engine/gpu/pipeline_library.h"

namespace vellus::gpu {

/// Part of a buffer that a shader sees as a uniform block.
struct UniformSlice {
    VkBuffer buffer = VK_NULL_HANDLE;
    uint64_t offset = 0;
    uint64_t bytes = 0;
};

/// Records into one command buffer and counts what a pass does; a view, cheap to pass around.
class CommandBuffer {
  public:
    explicit CommandBuffer(VkCommandBuffer handle) : handle_(handle) {}

    [[nodiscard]] VkCommandBuffer handle() const { return handle_; }
    [[nodiscard]] uint32_t draws() const { return draws_; }
    [[nodiscard]] uint32_t dispatches() const { return dispatches_; }

    void bind(const Pipeline& pipeline);
    /// The pass's images in binding order, then its uniform blocks; depth and sampled images must
    /// be in a read layout.
    void images(std::initializer_list<VkImageView> views,
                std::initializer_list<UniformSlice> uniforms = {});
    void images(std::span<const VkImageView> views, std::span<const UniformSlice> uniforms = {});
    /// Push constants; T must be as long as the pipeline's `push_bytes`.
    template <class T>
    void push(const T& constants) {
        assert(pipeline_ && sizeof(T) == pipeline_->push_bytes);
        push_bytes(&constants, sizeof(T));
    }
    void dispatch(uint32_t groups_x, uint32_t groups_y = 1, uint32_t groups_z = 1);
    /// Enough groups of `group_size` for `threads`, in rows where they are more than every device
    /// takes along one axis; shaders number them by common/thread.glsl.
    void dispatch_threads(uint32_t threads, uint32_t group_size);
    void draw(uint32_t vertices, uint32_t instances = 1, uint32_t first_vertex = 0);
    /// Draws with 32-bit indices from the start of `buffer`.
    void draw_indexed(VkBuffer buffer, uint32_t indices, uint32_t instances = 1);

  private:
    void push_bytes(const void* bytes, uint32_t size);

    VkCommandBuffer handle_;
    const Pipeline* pipeline_ = nullptr;
    uint32_t draws_ = 0;
    uint32_t dispatches_ = 0;
};

}  // namespace vellus::gpu
