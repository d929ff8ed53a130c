#include "engine/ecs/memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "engine/ecs/contract.h"

namespace vellus {
namespace {

constexpr size_t kHugePage = size_t{2} << 20U;
constexpr size_t kSmallestMapped = 2 * kHugePage;

bool is_mapped(size_t bytes) {
    return bytes >= kSmallestMapped;
}

size_t round_up(size_t bytes) {
    return (bytes + kHugePage - 1) / kHugePage * kHugePage;
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

void* map(size_t bytes) {
    void* const place = reserve(bytes);
    if (mprotect(place, bytes, PROT_READ | PROT_WRITE) != 0) checked(nullptr);
    madvise(place, bytes, MADV_HUGEPAGE);
    return place;
}

void* remap(void* old, size_t old_bytes, size_t bytes) {
    void* const place = reserve(bytes);
    return checked(mremap(old, old_bytes, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, place));
}

void release(void* old, size_t old_bytes) {
    if (is_mapped(old_bytes)) {
        munmap(old, round_up(old_bytes));
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
        if (round_up(bytes) == round_up(old_bytes)) return old;
        return remap(old, round_up(old_bytes), round_up(bytes));
    }
    if (!is_mapped(bytes) && !is_mapped(old_bytes)) return checked(std::realloc(old, bytes));
    void* const fresh = is_mapped(bytes) ? map(round_up(bytes)) : checked(std::malloc(bytes));
    if (old != nullptr) std::memcpy(fresh, old, std::min(old_bytes, bytes));
    release(old, old_bytes);
    return fresh;
}

}  // namespace vellus
