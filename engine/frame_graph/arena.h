#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace vellus::graph {

/// Bump memory that is given back all at once; keeps its blocks, so a steady frame allocates
/// nothing.
class Arena {
  public:
    void* allocate(size_t bytes, size_t alignment) {
        size_t offset = (used_ + alignment - 1) & ~(alignment - 1);
        if (block_ >= blocks_.size() || offset + bytes > blocks_[block_].bytes) {
            next_block(bytes);
            offset = 0;
        }
        used_ = offset + bytes;
        return blocks_[block_].data.get() + offset;
    }
    void reset() {
        block_ = 0;
        used_ = 0;
    }

  private:
    struct Block {
        std::unique_ptr<std::byte[]> data;  // new[] aligns to max_align_t, which bounds `alignment`
        size_t bytes = 0;
    };
    static constexpr size_t kBlockBytes = 64 << 10;

    void next_block(size_t bytes) {
        size_t next = blocks_.empty() ? 0 : block_ + 1;
        while (next < blocks_.size() && blocks_[next].bytes < bytes) ++next;
        if (next == blocks_.size()) {
            const size_t size = bytes > kBlockBytes ? bytes : kBlockBytes;
            blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(size), size});
        }
        block_ = next;
        used_ = 0;
    }

    std::vector<Block> blocks_;
    size_t block_ = 0;
    size_t used_ = 0;
};

}  // namespace vellus::graph
