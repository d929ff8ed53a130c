#pragma once

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>

#include "engine/asset/scene_asset.h"
#include "tests/support/fur.h"

namespace vellus::test {

/// A tube along Z from -0.5 to 0.5, radius 0.1, carried by joint 0 below and joint 1 above with
/// weights that change linearly in between.
class BentTube {
  public:
    BentTube(uint32_t around, uint32_t along) {
        for (uint32_t z = 0; z <= along; ++z) {
            for (uint32_t i = 0; i < around; ++i) {
                const double a = 2.0 * std::numbers::pi * i / around;
                positions_.emplace_back(0.1 * std::cos(a), 0.1 * std::sin(a),
                                        static_cast<double>(z) / along - 0.5);
            }
        }
        for (uint32_t z = 0; z < along; ++z) {
            for (uint32_t i = 0; i < around; ++i) {
                const uint32_t a = z * around + i;
                const uint32_t b = z * around + (i + 1) % around;
                triangles_.emplace_back(a, b, b + around);
                triangles_.emplace_back(a, b + around, a + around);
            }
        }
    }

    [[nodiscard]] asset::Mesh mesh() const { return to_mesh(positions_, triangles_); }

    /// The same surface with its vertices and triangles in another order, and from other corners.
    [[nodiscard]] asset::Mesh shuffled() const {
        std::vector<uint32_t> place(positions_.size());
        std::iota(place.begin(), place.end(), 0u);
        Random random(5, 0);
        for (size_t i = place.size(); i > 1; --i) {
            std::swap(place[i - 1], place[random.bits() % i]);
        }
        std::vector<glm::dvec3> moved(positions_.size());
        for (size_t v = 0; v < place.size(); ++v) moved[place[v]] = positions_[v];
        std::vector<glm::uvec3> triangles;
        for (const glm::uvec3& t : triangles_) {
            const auto k = static_cast<int>(random.bits() % 3);
            triangles.emplace_back(place[t[k]], place[t[(k + 1) % 3]], place[t[(k + 2) % 3]]);
        }
        std::ranges::reverse(triangles);
        return to_mesh(moved, triangles);
    }

    /// Each triangle as four.
    [[nodiscard]] asset::Mesh subdivided() const {
        std::vector<glm::dvec3> positions;
        std::vector<glm::uvec3> triangles;
        for (const glm::uvec3& t : triangles_) {
            const auto base = static_cast<uint32_t>(positions.size());
            const glm::dvec3 a = positions_[t.x];
            const glm::dvec3 b = positions_[t.y];
            const glm::dvec3 c = positions_[t.z];
            for (const auto& p : {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {
                positions.push_back(p);
            }
            for (const glm::uvec3 part : {glm::uvec3(0, 3, 5), glm::uvec3(3, 1, 4),
                                          glm::uvec3(5, 4, 2), glm::uvec3(3, 4, 5)}) {
                triangles.push_back(base + part);
            }
        }
        return to_mesh(positions, triangles);
    }

    [[nodiscard]] hair::StrandData fur(size_t count) const {
        // Off the open ends, where the nearest triangle of two meshes may differ.
        const Fur grown = grow_fur(positions_, triangles_, count, 0.05, 4);
        return hair::prepare_strands(grown.groom, glm::dmat4(1.0), 1e-3f);
    }
    [[nodiscard]] glm::vec3 outward(const glm::vec3& p) const {
        return glm::normalize(glm::vec3(p.x, p.y, 0.0f));
    }

  private:
    [[nodiscard]] static asset::Mesh to_mesh(const std::vector<glm::dvec3>& positions,
                                             const std::vector<glm::uvec3>& triangles) {
        asset::Primitive primitive;
        for (const glm::dvec3& p : positions) {
            primitive.positions.emplace_back(p);
            primitive.normals.emplace_back(glm::normalize(glm::dvec3(p.x, p.y, 0.0)));
            primitive.joints.emplace_back(0, 1, 0, 0);
            const auto upper = static_cast<float>(std::clamp(2.0 * p.z + 0.5, 0.0, 1.0));
            primitive.weights.emplace_back(1.0f - upper, upper, 0.0f, 0.0f);
        }
        for (const glm::uvec3& t : triangles) {
            for (int k = 0; k < 3; ++k) primitive.indices.push_back(t[k]);
        }
        return {"tube", {primitive}, {}};
    }

    std::vector<glm::dvec3> positions_;
    std::vector<glm::uvec3> triangles_;
};

}  // namespace vellus::test
