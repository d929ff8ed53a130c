#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace vellus::demo {

/// Pixels on one degree of the eye's field: 67 for a 0.7 m wide 4K monitor seen from 0.7 m.
constexpr double kPixelsPerDegree = 67.0;

/// How different two displayed pictures (sRGB-encoded, in [0, 1], same size) look at each pixel
/// when one alternates between them: 0 to 1. LDR-FLIP of Andersson, Nilsson, Akenine-Möller,
/// Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating Images", HPG
/// 2020.
std::vector<float> flip(const std::vector<glm::vec3>& picture,
                        const std::vector<glm::vec3>& reference, glm::uvec2 size,
                        double pixels_per_degree = kPixelsPerDegree);

}  // namespace vellus::demo
