#include "engine/ecs/memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace vellus {
namespace {

// Sizes on both sides of where blocks leave malloc, growing and shrinking.
TEST(ResizeMemory, KeepsTheContents) {
    const std::vector<size_t> sizes{100,       5000,      4'200'000, 4'300'000, 30'000'000,
                                    9'000'000, 4'194'304, 4'194'303, 64,        20'000'000};
    uint8_t* block = nullptr;
    size_t size = 0;
    const auto value = [](size_t i) { return static_cast<uint8_t>(i * 31 + i / 257); };
    for (const size_t next : sizes) {
        block = static_cast<uint8_t*>(resize_memory(block, size, next));
        ASSERT_EQ(reinterpret_cast<uintptr_t>(block) % alignof(std::max_align_t), 0U);
        size_t wrong = 0;
        for (size_t i = 0; i < std::min(size, next); ++i) wrong += block[i] != value(i) ? 1 : 0;
        ASSERT_EQ(wrong, 0U) << size << " -> " << next;
        for (size_t i = 0; i < next; ++i) block[i] = value(i);
        size = next;
    }
    EXPECT_EQ(resize_memory(block, size, 0), nullptr);
}

}  // namespace
}  // namespace vellus
