#pragma once

#include <cmath>
#include <vector>

#include "modules/hair/groom/strand_data.h"
#include "tests/support/sampling.h"

namespace vellus::test {

/// Strands grown out of a surface, and where each of them stands: known without any search.
struct Fur {
    hair::Groom groom;
    std::vector<uint32_t> triangle;       ///< by strand of the groom
    std::vector<glm::dvec2> barycentric;  ///< of the triangle's second and third corner
};

/// `count` strands of `points` points along the faces' normals, bent by a tenth of their length;
/// spread evenly over the area, deterministic.
inline Fur grow_fur(const std::vector<glm::dvec3>& positions,
                    const std::vector<glm::uvec3>& triangles, size_t count, double length,
                    uint32_t points) {
    std::vector<double> area(triangles.size());
    double total = 0.0;
    const auto face = [&](const glm::uvec3& t) {
        return glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
    };
    for (size_t t = 0; t < triangles.size(); ++t) {
        total += glm::length(face(triangles[t]));
        area[t] = total;
    }
    Fur fur;
    fur.groom.format = hair::GroomFormat::kGltf;
    for (size_t s = 0; s < count; ++s) {
        Random random(7, s);
        const double wanted =
            total * (static_cast<double>(s) + random.unit()) / static_cast<double>(count);
        const auto t =
            std::min(static_cast<size_t>(std::ranges::lower_bound(area, wanted) - area.begin()),
                     triangles.size() - 1);
        double u = random.unit();
        double v = random.unit();
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const glm::uvec3 corner = triangles[t];
        const glm::dvec3 root =
            positions[corner.x] * (1.0 - u - v) + positions[corner.y] * u + positions[corner.z] * v;
        const glm::dvec3 normal = glm::normalize(face(corner));
        const glm::dvec3 aside = random.direction();
        for (uint32_t i = 0; i < points; ++i) {
            const double along = static_cast<double>(i) / (points - 1);
            fur.groom.points.emplace_back(root + length * along * (normal + 0.1 * along * aside));
        }
        fur.groom.strand_begin.push_back(static_cast<uint32_t>(fur.groom.points.size()));
        fur.triangle.push_back(static_cast<uint32_t>(t));
        fur.barycentric.emplace_back(u, v);
    }
    return fur;
}

}  // namespace vellus::test
