#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace vellus {

constexpr uint64_t kHashSeed = 14695981039346656037ULL;

/// FNV-1a, 64 bit: for fingerprints of images and states, not for security. Chain by passing
/// `hash`.
constexpr uint64_t fnv1a(std::span<const std::byte> bytes, uint64_t hash = kHashSeed) {
    for (const std::byte byte : bytes) {
        hash = (hash ^ static_cast<uint64_t>(byte)) * 1099511628211ULL;
    }
    return hash;
}

}  // namespace vellus
