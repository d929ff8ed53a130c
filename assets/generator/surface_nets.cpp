#include "assets/generator/surface_nets.h"

#include <array>
#include <cmath>
#include <limits>

#include "assets/generator/sdf.h"
#include "engine/platform/jobs.h"

namespace vellus::sculpt {

namespace {

constexpr uint32_t kNoVertex = std::numeric_limits<uint32_t>::max();

struct Cells {
    const Grid& grid;
    std::array<size_t, 3> points;
    std::vector<double> values;

    explicit Cells(const Grid& lines, const Field& field)
        : grid(lines),
          points{lines.x.size(), lines.y.size(), lines.z.size()},
          values(points[0] * points[1] * points[2]) {
        parallel_ranges(points[2], 1, [&](size_t first, size_t last) {
            for (size_t k = first; k < last; ++k) {
                for (size_t j = 0; j < points[1]; ++j) {
                    for (size_t i = 0; i < points[0]; ++i) {
                        values[index(i, j, k)] = field({grid.x[i], grid.y[j], grid.z[k]});
                    }
                }
            }
        });
    }

    [[nodiscard]] size_t index(size_t i, size_t j, size_t k) const {
        return (k * points[1] + j) * points[0] + i;
    }
    [[nodiscard]] glm::dvec3 at(size_t i, size_t j, size_t k) const {
        return {grid.x[i], grid.y[j], grid.z[k]};
    }
};

/// Mean of the points where the surface crosses the edges of a cell; false if it crosses none.
bool cell_vertex(const Cells& cells, size_t i, size_t j, size_t k, glm::dvec3& vertex) {
    glm::dvec3 sum(0.0);
    int crossings = 0;
    for (size_t corner = 0; corner < 8; ++corner) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const size_t other = corner | (size_t{1} << axis);
            if (other == corner) {
                continue;
            }
            const auto corner_index = [&](size_t c) {
                return std::array{i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)};
            };
            const auto [ai, aj, ak] = corner_index(corner);
            const auto [bi, bj, bk] = corner_index(other);
            const double a = cells.values[cells.index(ai, aj, ak)];
            const double b = cells.values[cells.index(bi, bj, bk)];
            if ((a < 0.0) != (b < 0.0)) {
                sum += glm::mix(cells.at(ai, aj, ak), cells.at(bi, bj, bk), a / (a - b));
                ++crossings;
            }
        }
    }
    vertex = sum / static_cast<double>(std::max(crossings, 1));
    return crossings > 0;
}

void add_quad(Surface& surface, std::array<uint32_t, 4> q, bool flip) {
    if (flip) {
        std::swap(q[1], q[3]);
    }
    const auto& p = surface.positions;
    // The shorter diagonal makes the better pair of triangles.
    if (glm::distance(p[q[0]], p[q[2]]) <= glm::distance(p[q[1]], p[q[3]])) {
        surface.indices.insert(surface.indices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    } else {
        surface.indices.insert(surface.indices.end(), {q[1], q[2], q[3], q[1], q[3], q[0]});
    }
}

}  // namespace

std::vector<double> grid_lines(double begin, const std::vector<Stretch>& stretches) {
    std::vector<double> lines{begin};
    for (const Stretch& stretch : stretches) {
        const double start = lines.back();
        const int count = std::max(
            1, static_cast<int>(std::ceil((stretch.end - start) / stretch.spacing - 1e-9)));
        for (int i = 1; i <= count; ++i) {
            lines.push_back(start + (stretch.end - start) * i / count);
        }
    }
    return lines;
}

Surface surface_nets(const Grid& grid, const Field& field) {
    const Cells cells(grid, field);
    const auto [nx, ny, nz] = cells.points;
    Surface surface;
    std::vector<uint32_t> vertex_of(cells.values.size(), kNoVertex);
    for (size_t k = 0; k + 1 < nz; ++k) {
        for (size_t j = 0; j + 1 < ny; ++j) {
            for (size_t i = 0; i + 1 < nx; ++i) {
                glm::dvec3 vertex;
                if (cell_vertex(cells, i, j, k, vertex)) {
                    vertex_of[cells.index(i, j, k)] =
                        static_cast<uint32_t>(surface.positions.size());
                    surface.positions.push_back(vertex);
                }
            }
        }
    }
    const std::array<size_t, 3> step = {1, nx, nx * ny};
    for (size_t k = 1; k + 1 < nz; ++k) {
        for (size_t j = 1; j + 1 < ny; ++j) {
            for (size_t i = 1; i + 1 < nx; ++i) {
                const size_t here = cells.index(i, j, k);
                for (size_t axis = 0; axis < 3; ++axis) {
                    const bool inside = cells.values[here] < 0.0;
                    if (inside == (cells.values[here + step[axis]] < 0.0)) {
                        continue;
                    }
                    const size_t u = step[(axis + 1) % 3];
                    const size_t v = step[(axis + 2) % 3];
                    add_quad(surface,
                             {vertex_of[here - u - v], vertex_of[here - v], vertex_of[here],
                              vertex_of[here - u]},
                             !inside);
                }
            }
        }
    }
    return surface;
}

void settle(Surface& surface, const Field& field) {
    std::vector<double> reach(surface.positions.size(), std::numeric_limits<double>::max());
    for (size_t i = 0; i < surface.indices.size(); ++i) {
        const uint32_t a = surface.indices[i];
        const uint32_t b = surface.indices[i % 3 == 2 ? i - 2 : i + 1];
        const double half = 0.5 * glm::distance(surface.positions[a], surface.positions[b]);
        reach[a] = std::min(reach[a], half);
        reach[b] = std::min(reach[b], half);
    }
    surface.normals.resize(surface.positions.size());
    parallel_ranges(surface.positions.size(), 256, [&](size_t first, size_t last) {
        for (size_t v = first; v < last; ++v) {
            const glm::dvec3 start = surface.positions[v];
            const glm::dvec3 move = project(field, start) - start;
            const double length = glm::length(move);
            surface.positions[v] = start + (length > reach[v] ? move * (reach[v] / length) : move);
            surface.normals[v] = normal_of(field, surface.positions[v]);
        }
    });
}

}  // namespace vellus::sculpt
