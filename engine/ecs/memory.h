#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace vellus {

/// Gives a block of raw memory another size, keeping its contents up to the smaller one. Alignment
/// is that of malloc. Blocks of some MiB lie on huge pages where the system allows it, and grow by
/// remapping: their contents are never copied. Null and 0 bytes for none. Aborts when out of
/// memory.
void* resize_memory(void* old, size_t old_bytes, size_t bytes);

namespace detail {

/// Both ends of an object of kPart to 2 kPart bytes; they overlap, so any such size will do.
template <size_t kPart>
struct Ends {
    std::byte head[kPart];
    std::byte tail[kPart];

    Ends(const std::byte* from, size_t size) {
        std::memcpy(head, from, kPart);
        std::memcpy(tail, from + size - kPart, kPart);
    }
    void store(std::byte* to, size_t size) const {
        std::memcpy(to, head, kPart);
        std::memcpy(to + size - kPart, tail, kPart);
    }
};

}  // namespace detail

/// How to copy objects of a size known only at run time, without a call where they are small.
enum class CopyKind : uint8_t { kEndsOf8, kEndsOf4, kEndsOf16, kAnySize, kNotTrivial };

constexpr CopyKind copy_kind(bool trivial, size_t size) {
    if (!trivial) return CopyKind::kNotTrivial;
    if (size >= 4 && size < 8) return CopyKind::kEndsOf4;
    if (size >= 8 && size <= 16) return CopyKind::kEndsOf8;
    return size > 16 && size <= 32 ? CopyKind::kEndsOf16 : CopyKind::kAnySize;
}

/// Calls `work(copy)`, where `copy(to, from)` copies one object, maybe onto itself; false, and no
/// call, where the objects are not trivial.
template <class Work>
inline bool with_copy(CopyKind kind, size_t size, const Work& work) {
    const auto by_ends = [&]<size_t kPart>(std::integral_constant<size_t, kPart>) {
        work([size](std::byte* to, const std::byte* from) {
            detail::Ends<kPart>(from, size).store(to, size);
        });
    };
    if (kind == CopyKind::kEndsOf8) {
        by_ends(std::integral_constant<size_t, 8>{});
    } else if (kind == CopyKind::kEndsOf4) {
        by_ends(std::integral_constant<size_t, 4>{});
    } else if (kind == CopyKind::kEndsOf16) {
        by_ends(std::integral_constant<size_t, 16>{});
    } else if (kind == CopyKind::kAnySize) {
        work([size](std::byte* to, const std::byte* from) { std::memmove(to, from, size); });
    } else {
        return false;
    }
    return true;
}

}  // namespace vellus
