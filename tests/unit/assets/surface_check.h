#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "assets/generator/surface_nets.h"

namespace vellus::sculpt {

/// Pieces of a surface that share no edge.
inline size_t count_pieces(const Surface& surface) {
    std::vector<uint32_t> above(surface.positions.size());
    std::iota(above.begin(), above.end(), 0U);
    const auto root = [&](uint32_t v) {
        while (above[v] != v) {
            v = above[v] = above[above[v]];
        }
        return v;
    };
    for (size_t i = 0; i < surface.indices.size(); ++i) {
        above[root(surface.indices[i])] = root(surface.indices[i - i % 3]);
    }
    std::set<uint32_t> roots;
    for (const uint32_t v : surface.indices) {
        roots.insert(root(v));
    }
    return roots.size();
}

/// Every edge has two triangles that run it in opposite directions, no triangle is flat, and each
/// piece is like a ball (Euler's formula).
inline void expect_closed(const Surface& surface, const std::string& name) {
    std::map<std::pair<uint32_t, uint32_t>, int> half_edges;
    const auto& indices = surface.indices;
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint32_t next = indices[i % 3 == 2 ? i - 2 : i + 1];
        EXPECT_EQ((++half_edges[{indices[i], next}]), 1) << name;
    }
    for (const auto& [edge, count] : half_edges) {
        EXPECT_TRUE(half_edges.contains({edge.second, edge.first})) << name;
    }
    const auto euler = static_cast<int64_t>(surface.positions.size() + indices.size() / 3) -
                       static_cast<int64_t>(half_edges.size() / 2);
    EXPECT_EQ(euler, static_cast<int64_t>(2 * count_pieces(surface))) << name;
    for (size_t i = 0; i < indices.size(); i += 3) {
        const glm::dvec3 a = surface.positions[indices[i]];
        const glm::dvec3 n = glm::cross(surface.positions[indices[i + 1]] - a,
                                        surface.positions[indices[i + 2]] - a);
        // A thousandth of a square millimetre: far below a pixel, far above rounding.
        EXPECT_GT(0.5 * glm::length(n), 1e-9) << name << " triangle " << i / 3;
    }
}

}  // namespace vellus::sculpt
