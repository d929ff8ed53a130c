#include "modules/character/reference/skin.h"

#include <algorithm>

namespace vellus::character::reference {
namespace {

glm::dvec3 morph(const asset::Primitive& primitive, std::span<const float> weights, size_t vertex,
                 const std::vector<glm::vec3>& base,
                 std::vector<glm::vec3> asset::MorphTarget::*displacements) {
    glm::dvec3 value(base[vertex]);
    const size_t count = std::min(weights.size(), primitive.morph_targets.size());
    for (size_t t = 0; t < count; ++t) {
        const auto& deltas = primitive.morph_targets[t].*displacements;
        if (vertex < deltas.size()) {
            value += static_cast<double>(weights[t]) * glm::dvec3(deltas[vertex]);
        }
    }
    return value;
}

glm::dmat4 blend(const asset::Primitive& primitive, std::span<const glm::dmat4> palette,
                 size_t vertex) {
    if (primitive.joints.empty() || primitive.weights.empty()) return palette[0];
    glm::dmat4 sum(0.0);
    double total = 0.0;
    for (int k = 0; k < 4; ++k) {
        const double weight = primitive.weights[vertex][k];
        sum += weight * palette[primitive.joints[vertex][k]];
        total += weight;
    }
    return total > 0.0 ? sum / total : palette[primitive.joints[vertex][0]];
}

glm::dvec3 unit_or_z(const glm::dvec3& v) {
    const double squared = glm::dot(v, v);
    return squared > 0.0 ? v / std::sqrt(squared) : glm::dvec3(0, 0, 1);
}

}  // namespace

SkinnedVertices skin(const asset::Primitive& primitive, std::span<const glm::dmat4> palette,
                     std::span<const float> morph_weights) {
    SkinnedVertices result;
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        const glm::dmat4 matrix = blend(primitive, palette, v);
        const glm::dvec3 position =
            morph(primitive, morph_weights, v, primitive.positions, &asset::MorphTarget::positions);
        result.positions.emplace_back(matrix * glm::dvec4(position, 1.0));
        if (primitive.normals.empty()) continue;
        const glm::dvec3 normal =
            morph(primitive, morph_weights, v, primitive.normals, &asset::MorphTarget::normals);
        const glm::dmat3 linear(matrix);
        const bool regular = std::abs(glm::determinant(linear)) > 0.0;
        result.normals.push_back(
            unit_or_z(regular ? glm::transpose(glm::inverse(linear)) * normal : linear * normal));
    }
    return result;
}

}  // namespace vellus::character::reference
