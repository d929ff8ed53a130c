#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// A cross-section of a ribbon. The three axes are orthogonal, right-handed in the order across,
/// along, toward.
struct RibbonRow {
    glm::vec3 center{0.0f};
    glm::vec3 across{0.0f};  ///< unit
    glm::vec3 along{0.0f};   ///< unit, root to tip
    glm::vec3 toward{0.0f};  ///< unit, out of the card
    float half_width = 0.0f;
    float half_thickness = 0.0f;
    float distance = 0.0f;  ///< metres from the first row along the centres
};

/// A point as a ribbon sees it.
struct RibbonPoint {
    uint32_t interval = 0;  ///< between rows `interval` and the next
    float t = 0.0f;         ///< position there, in [0, 1]
    float across = 0.0f;    ///< metres from the middle
    float toward = 0.0f;
};

/// What a ribbon may look like.
struct RibbonLimits {
    uint32_t max_rows = 24;    ///< >= 2
    float tolerance = 0.001f;  ///< metres between the centreline and its polyline
    float tip_scale = 1.0f;    ///< of strand widths, as in HairWidth
};

/// A strip around a cluster of strands.
struct Ribbon {
    std::vector<RibbonRow> rows;

    [[nodiscard]] float length() const { return rows.back().distance; }
    /// The cross-section through `p`, a point at `fraction` of its strand's length, searched from
    /// the interval `hint` on; beyond the ends it is that of the end. Where the ribbon turns so
    /// tightly that the search ends in a cross-section far away, it is the one at the same
    /// fraction.
    [[nodiscard]] RibbonPoint locate(glm::vec3 p, float fraction, uint32_t hint) const;
    /// Distance along, half width and half thickness where a point lies.
    [[nodiscard]] float distance(const RibbonPoint& at) const;
    [[nodiscard]] float half_width(const RibbonPoint& at) const;
    [[nodiscard]] float half_thickness(const RibbonPoint& at) const;

  private:
    [[nodiscard]] RibbonPoint cross_section_through(glm::vec3 p, uint32_t hint) const;
    [[nodiscard]] RibbonPoint at_fraction(float fraction) const;
    /// Where `p` lies in that cross-section.
    void measure(glm::vec3 p, RibbonPoint& at) const;
};

/// A ribbon that holds all of these strands with their widths: its centreline follows their mean,
/// its width lies where they spread most (principal axis, turned smoothly along the length), and
/// its half axes reach the outermost strands, so that no area is lost; rows lie closer where it
/// bends. `members` are not empty.
Ribbon fit_ribbon(const StrandData& strands, std::span<const uint32_t> members,
                  const RibbonLimits& limits);

}  // namespace vellus::hair
