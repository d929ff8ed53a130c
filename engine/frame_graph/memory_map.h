#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace vellus::graph {

/// Accesses to memory that must end before it gets another owner.
struct MemoryTag {
    uint32_t stages = 0;
    uint32_t write_access = 0;
    uint32_t last_step = ~0U;
};

struct MemoryBlock {
    uint32_t node = ~0U;
    uint64_t offset = 0;
    MemoryTag tag;  ///< of all former owners in this frame
};

/// Offsets in a growing span of memory: two-level segregated fit (Masmano et al. 2004), constant
/// time. Free blocks remember the tags of their former owners; merging unites them.
class MemoryMap {
  public:
    void reset();
    MemoryBlock allocate(uint64_t bytes, uint64_t alignment) {
        bytes = (std::max<uint64_t>(bytes, 1) + kGranule - 1) & ~(kGranule - 1);
        alignment = std::max(alignment, kGranule);
        const bool fits = warm_ != kNil && nodes_[warm_].bytes == bytes &&
                          (nodes_[warm_].offset & (alignment - 1)) == 0;
        const uint32_t node = fits ? std::exchange(warm_, kNil) : find_or_grow(bytes, alignment);
        return {node, nodes_[node].offset, nodes_[node].tag};
    }
    void free(uint32_t node, const MemoryTag& tag) {
        assert(node < nodes_.size() && !nodes_[node].is_free && node != warm_);
        if (warm_ != kNil) settle();
        nodes_[node].tag = tag;  // the last owner waited for those before it
        warm_ = node;
    }
    /// Bytes from 0 that were ever in use.
    [[nodiscard]] uint64_t high_water() const { return high_water_; }

  private:
    static constexpr uint32_t kNil = ~0U;
    static constexpr uint32_t kSubBits = 3;
    static constexpr uint32_t kSub = 1U << kSubBits;
    static constexpr uint32_t kGranuleBits = 6;  // 64 bytes
    static constexpr uint64_t kGranule = uint64_t{1} << kGranuleBits;
    static constexpr uint32_t kLevels = 48;

    struct Node {
        uint64_t offset = 0;
        uint64_t bytes = 0;
        MemoryTag tag;
        uint32_t before = kNil, after = kNil;   // neighbours in memory
        uint32_t previous = kNil, next = kNil;  // neighbours in the bin
        bool is_free = false;
    };

    uint32_t find_or_grow(uint64_t bytes, uint64_t alignment);
    static uint32_t bin_of(uint64_t bytes);
    uint32_t new_node(const Node& node);
    uint32_t find(uint64_t bytes, uint64_t alignment) const;
    uint32_t grow(uint64_t bytes, uint64_t alignment);
    void cut_front(uint32_t node, uint64_t bytes);
    void cut_back(uint32_t node, uint64_t bytes);
    void settle();
    void link(uint32_t node);
    void unlink(uint32_t node);
    uint32_t merge_with_after(uint32_t node);

    std::vector<Node> nodes_;
    std::vector<uint32_t> spare_;
    std::array<uint32_t, kLevels * kSub> bins_{};
    std::array<uint8_t, kLevels> sub_mask_{};
    uint64_t level_mask_ = 0;
    uint32_t last_ = kNil;
    uint32_t warm_ = kNil;  // freed last and not yet in a bin: the next of its size takes it
    uint64_t high_water_ = 0;
};

}  // namespace vellus::graph
