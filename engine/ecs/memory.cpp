#include "engine/ecs/memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "engine/ecs/contract.h"

namespace vellus {
namespace {

constexpr size_t kHugePage = size_t{2} << 20U;
constexpr size_t kSmallestMapped = 2 * kHugePage;

// Blocks that all began on a huge page would have equal rows of all columns compete for the same
// cache sets, and take loads for stores 4 KiB apart. So each begins at another offset into its
// page.
constexpr size_t kOffsets = 32;
constexpr size_t kOffsetStep = 7 * 64;

size_t next_offset() {
    static std::atomic<size_t> count{0};
    return count.fetch_add(1, std::memory_order_relaxed) % kOffsets * kOffsetStep;
}

size_t offset_of(const void* block) {
    return reinterpret_cast<uintptr_t>(block) % kHugePage;
}

bool is_mapped(size_t bytes) {
    return bytes >= kSmallestMapped;
}

/// Of the mapping that holds a block of so many bytes.
size_t mapped_size(size_t bytes) {
    return (bytes + kOffsets * kOffsetStep + kHugePage - 1) / kHugePage * kHugePage;
}

void* checked(void* memory) {
    if (memory == nullptr || memory == MAP_FAILED) {
        contract_failed("ecs: out of memory for a component column");
    }
    return memory;
}

/// Address space that starts on a huge page: a larger piece is reserved and its ends given back.
std::byte* reserve(size_t bytes) {
    constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    auto* const all = static_cast<std::byte*>(
        checked(mmap(nullptr, bytes + kHugePage, PROT_NONE, kFlags, -1, 0)));
    const size_t head = (kHugePage - reinterpret_cast<uintptr_t>(all) % kHugePage) % kHugePage;
    if (head > 0) munmap(all, head);
    munmap(all + head + bytes, kHugePage - head);
    return all + head;
}

std::byte* map(size_t bytes) {
    std::byte* const place = reserve(mapped_size(bytes));
    if (mprotect(place, mapped_size(bytes), PROT_READ | PROT_WRITE) != 0) checked(nullptr);
    madvise(place, mapped_size(bytes), MADV_HUGEPAGE);
    return place + next_offset();
}

std::byte* remap(std::byte* old, size_t old_bytes, size_t bytes) {
    if (mapped_size(bytes) == mapped_size(old_bytes)) return old;
    std::byte* const place = reserve(mapped_size(bytes));
    checked(mremap(old - offset_of(old), mapped_size(old_bytes), mapped_size(bytes),
                   MREMAP_MAYMOVE | MREMAP_FIXED, place));
    return place + offset_of(old);
}

void release(void* old, size_t old_bytes) {
    if (is_mapped(old_bytes)) {
        munmap(static_cast<std::byte*>(old) - offset_of(old), mapped_size(old_bytes));
    } else {
        std::free(old);
    }
}

}  // namespace

void* resize_memory(void* old, size_t old_bytes, size_t bytes) {
    if (bytes == 0) {
        release(old, old_bytes);
        return nullptr;
    }
    if (is_mapped(bytes) && is_mapped(old_bytes)) {
        return remap(static_cast<std::byte*>(old), old_bytes, bytes);
    }
    if (!is_mapped(bytes) && !is_mapped(old_bytes)) return checked(std::realloc(old, bytes));
    void* const fresh = is_mapped(bytes) ? map(bytes) : checked(std::malloc(bytes));
    if (old != nullptr) std::memcpy(fresh, old, std::min(old_bytes, bytes));
    release(old, old_bytes);
    return fresh;
}

}  // namespace vellus
