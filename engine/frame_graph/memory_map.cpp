#include "engine/frame_graph/memory_map.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace vellus::graph {

namespace {

uint64_t align(uint64_t offset, uint64_t alignment) {
    return (offset + alignment - 1) & ~(alignment - 1);
}

MemoryTag unite(const MemoryTag& a, const MemoryTag& b) {
    if (a.stages == 0) return b;
    if (b.stages == 0) return a;
    return {a.stages | b.stages, a.write_access | b.write_access,
            std::max(a.last_step, b.last_step)};
}

}  // namespace

void MemoryMap::reset() {
    nodes_.clear();
    spare_.clear();
    bins_.fill(kNil);
    sub_mask_.fill(0);
    level_mask_ = 0;
    last_ = kNil;
    warm_ = kNil;
    high_water_ = 0;
}

uint32_t MemoryMap::bin_of(uint64_t bytes) {
    const uint64_t granules = bytes >> kGranuleBits;
    assert(granules > 0);
    if (granules < kSub) return static_cast<uint32_t>(granules);
    const auto top = static_cast<uint32_t>(std::bit_width(granules)) - 1;
    const auto sub = static_cast<uint32_t>(granules >> (top - kSubBits)) & (kSub - 1);
    return ((top - kSubBits + 1) << kSubBits) + sub;
}

uint32_t MemoryMap::new_node(const Node& node) {
    if (spare_.empty()) {
        nodes_.push_back(node);
        return static_cast<uint32_t>(nodes_.size() - 1);
    }
    const uint32_t index = spare_.back();
    spare_.pop_back();
    nodes_[index] = node;
    return index;
}

void MemoryMap::link(uint32_t node) {
    const uint32_t bin = bin_of(nodes_[node].bytes);
    nodes_[node].is_free = true;
    nodes_[node].previous = kNil;
    nodes_[node].next = bins_[bin];
    if (bins_[bin] != kNil) nodes_[bins_[bin]].previous = node;
    bins_[bin] = node;
    sub_mask_[bin >> kSubBits] |= static_cast<uint8_t>(1U << (bin & (kSub - 1)));
    level_mask_ |= uint64_t{1} << (bin >> kSubBits);
}

void MemoryMap::unlink(uint32_t node) {
    Node& gone = nodes_[node];
    const uint32_t bin = bin_of(gone.bytes);
    if (gone.previous != kNil) nodes_[gone.previous].next = gone.next;
    if (gone.next != kNil) nodes_[gone.next].previous = gone.previous;
    if (bins_[bin] == node) bins_[bin] = gone.next;
    if (bins_[bin] == kNil) {
        const uint32_t level = bin >> kSubBits;
        sub_mask_[level] &= static_cast<uint8_t>(~(1U << (bin & (kSub - 1))));
        if (sub_mask_[level] == 0) level_mask_ &= ~(uint64_t{1} << level);
    }
    gone.is_free = false;
}

uint32_t MemoryMap::find(uint64_t bytes, uint64_t alignment) const {
    const auto fits = [&](uint32_t node) {
        const Node& n = nodes_[node];
        return align(n.offset, alignment) + bytes <= n.offset + n.bytes;
    };
    // The bin of the size itself may hold a perfect fit; a few looks keep the time constant.
    const uint32_t bin = bin_of(bytes);
    uint32_t node = bins_[bin];
    for (int look = 0; look < 4 && node != kNil; ++look, node = nodes_[node].next) {
        if (fits(node)) return node;
    }
    // Any block of a higher bin is large enough, but for alignment; look at the head of each.
    uint32_t level = bin >> kSubBits;
    uint32_t subs = sub_mask_[level] & ~((2U << (bin & (kSub - 1))) - 1U);
    uint64_t levels = level_mask_ & ~((uint64_t{2} << level) - 1);
    while (true) {
        for (; subs != 0; subs &= subs - 1) {
            const auto sub = static_cast<uint32_t>(std::countr_zero(subs));
            node = bins_[(level << kSubBits) + sub];
            if (fits(node)) return node;
        }
        if (levels == 0) return kNil;
        level = static_cast<uint32_t>(std::countr_zero(levels));
        levels &= levels - 1;
        subs = sub_mask_[level];
    }
}

uint32_t MemoryMap::grow(uint64_t bytes, uint64_t alignment) {
    if (last_ != kNil && nodes_[last_].is_free) {  // the free end grows if it must
        unlink(last_);
        Node& end = nodes_[last_];
        end.bytes = std::max(end.bytes, align(end.offset, alignment) + bytes - end.offset);
        return last_;
    }
    const uint64_t start = last_ == kNil ? 0 : nodes_[last_].offset + nodes_[last_].bytes;
    const uint32_t node = new_node(
        {.offset = start, .bytes = align(start, alignment) + bytes - start, .before = last_});
    if (last_ != kNil) nodes_[last_].after = node;
    last_ = node;
    return node;
}

void MemoryMap::cut_front(uint32_t node, uint64_t bytes) {
    const Node old = nodes_[node];
    const uint32_t front = new_node({.offset = old.offset,
                                     .bytes = bytes,
                                     .tag = old.tag,
                                     .before = old.before,
                                     .after = node});
    if (old.before != kNil) nodes_[old.before].after = front;
    nodes_[node].before = front;
    nodes_[node].offset += bytes;
    nodes_[node].bytes -= bytes;
    link(front);
}

void MemoryMap::cut_back(uint32_t node, uint64_t bytes) {
    const Node old = nodes_[node];
    const uint32_t back = new_node({.offset = old.offset + bytes,
                                    .bytes = old.bytes - bytes,
                                    .tag = old.tag,
                                    .before = node,
                                    .after = old.after});
    if (old.after != kNil) nodes_[old.after].before = back;
    if (last_ == node) last_ = back;
    nodes_[node].after = back;
    nodes_[node].bytes = bytes;
    link(back);
}

uint32_t MemoryMap::find_or_grow(uint64_t bytes, uint64_t alignment) {
    if (warm_ != kNil) settle();
    uint32_t node = find(bytes, alignment);
    if (node != kNil) {
        unlink(node);
    } else {
        node = grow(bytes, alignment);
    }
    const uint64_t padding = align(nodes_[node].offset, alignment) - nodes_[node].offset;
    if (padding != 0) cut_front(node, padding);
    if (nodes_[node].bytes > bytes) cut_back(node, bytes);
    high_water_ = std::max(high_water_, nodes_[node].offset + bytes);
    return node;
}

uint32_t MemoryMap::merge_with_after(uint32_t node) {
    const uint32_t after = nodes_[node].after;
    unlink(after);
    nodes_[node].bytes += nodes_[after].bytes;
    nodes_[node].tag = unite(nodes_[node].tag, nodes_[after].tag);
    nodes_[node].after = nodes_[after].after;
    if (nodes_[after].after != kNil) nodes_[nodes_[after].after].before = node;
    if (last_ == after) last_ = node;
    spare_.push_back(after);
    return node;
}

/// Joins the block freed last with its free neighbours and puts it into its bin.
void MemoryMap::settle() {
    uint32_t node = warm_;
    warm_ = kNil;
    const uint32_t after = nodes_[node].after;
    if (after != kNil && nodes_[after].is_free) merge_with_after(node);
    const uint32_t before = nodes_[node].before;
    if (before != kNil && nodes_[before].is_free) {
        unlink(before);
        link(node);  // merge_with_after() expects the one that goes to be in a bin
        node = merge_with_after(before);
    }
    link(node);
}

}  // namespace vellus::graph
