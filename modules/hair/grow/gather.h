#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "modules/hair/grow/closest.h"
#include "modules/hair/grow/head.h"

namespace vellus::hair::grow {

/// Hair that is tied together: a band at the back of the head, and the tail's middle line from
/// there.
struct Gather {
    glm::dvec3 band{0.0};
    double radius = 0.012;  ///< of the tail at the band, in metres
    double step = 0.004;    ///< between points of the line
    std::vector<glm::dvec3> line;
    /// Across the line: to the person's left, and away from the body.
    std::vector<glm::dvec3> left;
    std::vector<glm::dvec3> back;

    /// The middle line and its axes `s` metres behind the band, beyond its end straight on.
    struct Frame {
        glm::dvec3 position, left, back;
    };
    [[nodiscard]] Frame at(double s) const;
};

/// A tail `length` metres long behind the head, held off the body.
Gather make_gather(const ClosestPoint& body, const Head& head, const GrowSettings& settings);

/// Where a hair of the tail is `s` metres behind the band: `place` in the unit disc is its place
/// in the cross-section, `end` the length of the hair behind the band.
glm::dvec3 tail_point(const Gather& gather, const GrowSettings& settings, glm::dvec2 place,
                      double s, double end);

}  // namespace vellus::hair::grow
