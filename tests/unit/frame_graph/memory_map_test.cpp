#include "engine/frame_graph/memory_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace vellus::graph {
namespace {

struct Owned {
    MemoryBlock block;
    uint64_t bytes;
    uint32_t id;
};

// Random allocations against a plain list: aligned, never overlapping, and a block's tag contains
// that of every owner who had any of its bytes last.
TEST(MemoryMap, RandomUseNeverOverlapsAndRemembersOwners) {
    std::mt19937 random(7);
    const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
    for (int round = 0; round < 40; ++round) {
        MemoryMap map;
        std::vector<Owned> live;
        std::vector<uint32_t> last_tag(1 << 15);  // per 64 bytes: tag of the last owner
        map.reset();
        for (uint32_t i = 0; i < 400; ++i) {
            if (!live.empty() && below(2) == 0) {
                const size_t victim = below(static_cast<uint32_t>(live.size()));
                const uint32_t tag = 1U << below(16);
                map.free(live[victim].block.node, {tag, tag, i});
                const uint64_t first = live[victim].block.offset / 64;
                std::fill_n(last_tag.begin() + static_cast<ptrdiff_t>(first),
                            (live[victim].bytes + 63) / 64, tag);
                live.erase(live.begin() + static_cast<ptrdiff_t>(victim));
                continue;
            }
            const uint64_t bytes = 1 + below(3000), alignment = 64U << below(5);
            const MemoryBlock block = map.allocate(bytes, alignment);
            ASSERT_EQ(block.offset % alignment, 0U);
            ASSERT_LE(block.offset + bytes, map.high_water());
            for (const Owned& other : live) {
                ASSERT_TRUE(block.offset + bytes <= other.block.offset ||
                            other.block.offset + other.bytes <= block.offset);
            }
            for (uint64_t granule = block.offset / 64; granule * 64 < block.offset + bytes;
                 ++granule) {
                ASSERT_EQ(last_tag.at(granule) & ~block.tag.stages, 0U);
            }
            live.push_back({block, bytes, i});
        }
    }
}

TEST(MemoryMap, NeighboursMergeAndAreUsedAgain) {
    MemoryMap map;
    map.reset();
    const MemoryBlock a = map.allocate(1024, 64), b = map.allocate(1024, 64),
                      c = map.allocate(1024, 64);
    map.free(a.node, {1, 0, 0});
    map.free(c.node, {4, 0, 0});
    map.free(b.node, {2, 0, 0});
    const MemoryBlock all = map.allocate(3072, 64);
    EXPECT_EQ(all.offset, 0U);
    EXPECT_EQ(all.tag.stages, 7U);
    EXPECT_EQ(map.high_water(), 3072U);
}

}  // namespace
}  // namespace vellus::graph
