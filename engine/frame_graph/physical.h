#pragma once

// Vulkan objects behind a plan's resources; internal to this folder.

#include <array>
#include <unordered_map>
#include <vector>

#include "engine/frame_graph/compile.h"
#include "engine/gpu/image.h"

namespace vellus::graph {

/// Destroys or frees things once the frames that may use them are done.
class Graveyard {
  public:
    explicit Graveyard(gpu::Device& device) : device_(device) {}
    ~Graveyard() { bury(~0ULL); }
    Graveyard(const Graveyard&) = delete;
    Graveyard& operator=(const Graveyard&) = delete;

    struct Grave {
        uint64_t frame = 0;  ///< the last that may use it
        VkImage image = VK_NULL_HANDLE;
        VkBuffer buffer = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        gpu::Allocation memory;
    };
    /// Something was made that will be added one day: room for it is made now, as giving up what an
    /// earlier kind of frame used falls into frames that allocate nothing.
    void expect();
    void add(const Grave& grave) { graves_.push_back(grave); }
    void add(uint64_t frame, gpu::Image&& image) { images_.push_back({frame, std::move(image)}); }
    /// Frames up to `done` have ended.
    void bury(uint64_t done);

  private:
    struct OldImage {
        uint64_t frame;
        gpu::Image image;
    };
    gpu::Device& device_;
    std::vector<Grave> graves_;
    std::vector<OldImage> images_;
    size_t expected_ = 0;  // still in use, or here and not yet destroyed
};

struct ViewOfRange {
    ImageRange range;
    VkImageView view = VK_NULL_HANDLE;
};

/// What a resource of the current frame is on the device.
struct Physical {
    VkImage image = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceAddress address = 0;
    VkImageView whole = VK_NULL_HANDLE;         ///< imported images
    std::vector<ViewOfRange>* views = nullptr;  ///< cache; null for imported images
    bool history_valid = false;
};

/// Memory for transient resources, and the images and buffers placed in it, kept from frame to
/// frame as long as plans ask for the same.
class TransientHeap {
  public:
    TransientHeap(gpu::Device& device, Graveyard& graveyard)
        : device_(device), graveyard_(graveyard) {}
    ~TransientHeap();
    TransientHeap(const TransientHeap&) = delete;
    TransientHeap& operator=(const TransientHeap&) = delete;

    /// Requirements from the driver, asked once per description and usage.
    MemoryNeeds needs(const ResourceRecord& resource, uint32_t usage);
    /// Fills in the transient resources of `physical`.
    Result<void> bind(const GraphDescription& graph, const Plan& plan, uint64_t frame,
                      std::vector<Physical>& physical);
    /// Gives up what has not been used for a while.
    void trim(uint64_t frame);
    [[nodiscard]] uint64_t bytes_held() const;
    [[nodiscard]] uint64_t created() const { return created_; }
    void count_view() { ++created_; }

  private:
    struct Block {
        ResourceKind kind = ResourceKind::kImage;
        uint32_t type_bits = 0;
        gpu::Allocation memory;
        uint64_t id = 0;
        uint64_t last_fit = 0;  ///< last frame that used at least half of it
    };
    struct Key {
        ImageDesc image{};
        uint64_t bytes = 0;
        uint32_t usage = 0;
        uint64_t block = 0;
        uint64_t offset = 0;
        bool operator==(const Key&) const = default;
    };
    struct KeyHash {
        size_t operator()(const Key& key) const;
    };
    struct Placed {
        VkImage image = VK_NULL_HANDLE;
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceAddress address = 0;
        std::vector<ViewOfRange> views;
        uint64_t last_frame = 0;
    };

    Result<Block*> block_for(const Pool& pool, uint64_t frame);
    Result<Placed> make(const ResourceRecord& resource, const Placement& placement,
                        const Block& block);
    void retire(const Placed& placed);
    void retire_block(Block& block);

    gpu::Device& device_;
    Graveyard& graveyard_;
    std::vector<Block> blocks_;
    std::vector<Block*> pool_blocks_;
    std::unordered_map<Key, Placed, KeyHash> placed_;
    std::unordered_map<Key, MemoryNeeds, KeyHash> needs_;
    uint64_t next_id_ = 1;
    uint64_t created_ = 0;
};

/// A view of a range, made once where `views` keeps it.
Result<VkImageView> view_of(gpu::Device& device, const ImageDesc& desc, VkImage image,
                            const ImageRange& range, std::vector<ViewOfRange>& views,
                            Graveyard& graveyard, uint64_t& created);

}  // namespace vellus::graph
