#pragma once

#include <cstdint>
#include <functional>

namespace vellus {

/// A handle: slot number and the generation that slot had when the entity was made. A handle to a
/// destroyed entity stays dead for ever: a slot whose generations are used up is retired.
struct Entity {
    uint32_t index = UINT32_MAX;
    /// Live entities start at 1; 0 marks "none" and Commands' pending ones.
    uint32_t generation = 0;

    friend constexpr bool operator==(const Entity&, const Entity&) = default;
    friend constexpr bool operator<(const Entity& a, const Entity& b) noexcept {
        return a.index != b.index ? a.index < b.index : a.generation < b.generation;
    }
};

/// The handle of nothing; never alive.
inline constexpr Entity kNoEntity{};

}  // namespace vellus

template <>
struct std::hash<vellus::Entity> {
    size_t operator()(const vellus::Entity& entity) const noexcept {
        return std::hash<uint64_t>{}(uint64_t{entity.generation} << 32U | entity.index);
    }
};
