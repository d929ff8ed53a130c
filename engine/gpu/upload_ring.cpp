#include "engine/gpu/upload_ring.h"

#include "engine/platform/log.h"

namespace vellus::gpu {

namespace {
// The largest minUniformBufferOffsetAlignment Vulkan allows.
constexpr uint64_t kAlignment = 256;
}  // namespace

Result<UploadRing> UploadRing::create(Device& device, uint64_t bytes_per_frame, uint32_t frames) {
    auto buffer = Buffer::create(device, bytes_per_frame * frames, MemoryKind::kUpload, "uploads");
    if (!buffer) return buffer.error();
    UploadRing ring;
    ring.buffer_ = std::move(*buffer);
    ring.bytes_per_frame_ = bytes_per_frame;
    ring.frames_ = frames;
    return ring;
}

void UploadRing::begin_frame() {
    frame_ = (frame_ + 1) % frames_;
    used_ = 0;
}

VkDeviceAddress UploadRing::push_bytes(std::span<const std::byte> bytes) {
    if (used_ + bytes.size() > bytes_per_frame_) {
        log_error("uploads of one frame exceed {} bytes", bytes_per_frame_);
        return 0;
    }
    const uint64_t offset = frame_ * bytes_per_frame_ + used_;
    std::memcpy(buffer_.mapped() + offset, bytes.data(), bytes.size());
    used_ += (bytes.size() + kAlignment - 1) / kAlignment * kAlignment;
    return buffer_.address() + offset;
}

}  // namespace vellus::gpu
