#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "modules/hair/environment/ambient_pieces.h"
#include "modules/hair/groom/strand_area.h"

namespace vellus::hair {

/// How wide strands are: metres at the root, and that times `tip_scale` at the tip.
struct StrandTaper {
    float root = 1e-4f;
    float tip_scale = 1.0f;
};

/// Points of strands or cards, each of which begins at its root: points[begin[i]].
struct AmbientRoots {
    std::span<const glm::vec3> points;
    std::span<const uint32_t> begin;

    [[nodiscard]] size_t count() const { return begin.empty() ? 0 : begin.size() - 1; }
    [[nodiscard]] glm::vec3 at(size_t i) const { return points[begin[i]]; }
};

/// Strands in cells of `cell` metres, by x, then y, then z.
struct AmbientGrid {
    glm::ivec3 size{1};
    float cell = 1.0f;
    std::vector<StrandArea> strands;  ///< per volume

    [[nodiscard]] size_t index(const glm::ivec3& c) const {
        return (static_cast<size_t>(c.z) * static_cast<size_t>(size.y) + static_cast<size_t>(c.y)) *
                   static_cast<size_t>(size.x) +
               static_cast<size_t>(c.x);
    }
    [[nodiscard]] bool holds(const glm::ivec3& c) const {
        return glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) &&
               glm::all(glm::lessThan(c, size));
    }
    /// The cell at `p`, in cells, or the nearest to it.
    [[nodiscard]] size_t near(const glm::vec3& p) const {
        return index(glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), size - 1));
    }
};

/// A groom's strands as a density of area, about 100 cells along its longest side, and skin, which
/// nothing passes.
struct AmbientVolume {
    glm::vec3 origin{0.0f};
    std::vector<AmbientGrid> mips;  ///< each of half as many cells a side
    std::vector<uint8_t> skin;      ///< by cell of the finest grid; empty where none is known of

    [[nodiscard]] float cell() const { return mips[0].cell; }
    [[nodiscard]] glm::vec3 extent() const { return glm::vec3(mips[0].size) * mips[0].cell; }
};

/// Without skin. Needs points.
AmbientVolume ambient_volume(const AmbientRoots& strands, const StrandTaper& taper);
/// The same of anything that stops light; `cards` say how far it reaches.
AmbientVolume ambient_volume(const AmbientRoots& cards, const AmbientPieces& pieces);

/// Skin just below the roots, where these stand all over something round.
void add_skin_below(const AmbientRoots& roots, AmbientVolume& volume);
/// Skin in each cell that a triangle passes through.
void add_skin(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
              AmbientVolume& volume);

/// Metres from `p`, anywhere, along unit `d` to skin; infinite where there is none around the
/// groom.
float skin_along(const AmbientVolume& volume, const glm::vec3& p, const glm::vec3& d);

/// Optical depth of hair from `p`, anywhere, along unit `d` for `end` metres, in steps that grow
/// with distance.
float depth_along(const AmbientVolume& volume, const glm::vec3& p, const glm::vec3& d, float end);

}  // namespace vellus::hair
