#pragma once

#include <span>

#include "modules/hair/cards/ribbon.h"

// Steps of fit_ribbon.
namespace vellus::hair::detail {

/// A unit vector perpendicular to `axis`, the same for the same axis.
glm::vec3 any_perpendicular(glm::vec3 axis);

/// `passes` of the binomial filter 1 2 1; the ends stay.
void smooth(std::vector<glm::vec3>& line, int passes);

/// Radians that the line turns where a point's cross-section meets its neighbour's within `radius`
/// of the line (one per point).
float crowded_turn(const std::vector<glm::vec3>& line, std::span<const float> radius);

/// Up to `passes` of that filter, ends too, where a point's cross-section meets its neighbour's
/// within `radius` of the line (one per point); false where none does.
bool straighten(std::vector<glm::vec3>& line, std::span<const float> radius, int passes);

/// Distances and directions from the rows' centres: central differences, as the shader takes them.
void update_along(Ribbon& ribbon);

/// Rows at these centres with frames that turn about no axis but the bend's (double reflection,
/// Wang et al. 2008, "Computation of Rotation Minimizing Frames").
Ribbon transport_frames(const std::vector<glm::vec3>& centers);

/// Turns each row about `along` so that `across` lies where the points spread most, smoothly from
/// row to row.
void turn_to_principal_axis(std::span<const RibbonPoint> points, Ribbon& ribbon);

/// Moves the rows to the middle between the outermost points.
void move_to_middle(std::span<const RibbonPoint> points, Ribbon& ribbon);

/// First and last row, and those between without which a centre would lie farther than `tolerance`
/// metres from the polyline (Douglas and Peucker 1973) or an interval would span more than
/// `longest` rows.
std::vector<uint32_t> rows_to_keep(const Ribbon& ribbon, float tolerance, uint32_t longest);

}  // namespace vellus::hair::detail
