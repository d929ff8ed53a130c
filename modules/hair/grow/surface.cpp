#include "modules/hair/grow/surface.h"

#include <cmath>

#include "modules/hair/grow/chance.h"

namespace vellus::hair {

namespace {

constexpr int kRings = 48;
constexpr int kSectors = 96;
/// A mask is sampled at the square of this many points of a triangle.
constexpr int kMaskRows = 4;

/// Point of the unit sphere; waves made unit again are exact to rounding.
glm::dvec3 sphere_point(int ring, int sector) {
    const double down = 0.5 * ring / kRings;
    const double around = static_cast<double>(sector) / kSectors;
    const glm::dvec2 flat =
        glm::normalize(glm::dvec2(grow::wave(around), grow::wave(around + 0.25)));
    const glm::dvec2 profile =
        ring == 0        ? glm::dvec2(0.0, 1.0)
        : ring == kRings ? glm::dvec2(0.0, -1.0)
                         : glm::normalize(glm::dvec2(grow::wave(down), grow::wave(down + 0.25)));
    return {flat.x * profile.x, profile.y, flat.y * profile.x};
}

}  // namespace

GrowSurface sphere_surface(glm::vec3 center, float radius, bool whole) {
    GrowSurface surface;
    for (int ring = 0; ring <= kRings; ++ring) {
        for (int sector = 0; sector <= kSectors; ++sector) {
            const glm::vec3 normal(sphere_point(ring, sector % kSectors));
            surface.positions.push_back(center + normal * radius);
            surface.normals.push_back(normal);
            surface.uvs.emplace_back(static_cast<float>(sector) / kSectors,
                                     static_cast<float>(ring) / kRings);
            const double above = normal.y - 0.75 * normal.z + 0.35;
            surface.density.push_back(
                whole ? 1.0f : static_cast<float>(grow::smoothstep(-0.03, 0.03, above)));
        }
    }
    for (int ring = 0; ring < kRings; ++ring) {
        for (int sector = 0; sector < kSectors; ++sector) {
            const auto a = static_cast<uint32_t>(ring * (kSectors + 1) + sector);
            const uint32_t b = a + kSectors + 1;
            if (ring > 0) surface.triangles.insert(surface.triangles.end(), {a, b, a + 1});
            if (ring + 1 < kRings) {
                surface.triangles.insert(surface.triangles.end(), {a + 1, b, b + 1});
            }
        }
    }
    return surface;
}

double density_at(const GrowSurface& surface, size_t triangle, double u, double v) {
    const uint32_t* corner = &surface.triangles[3 * triangle];
    const float w[3] = {static_cast<float>(1.0 - u - v), static_cast<float>(u),
                        static_cast<float>(v)};
    float density = 0.0f;
    glm::vec3 position(0.0f);
    glm::vec2 uv(0.0f);
    for (int i = 0; i < 3; ++i) {
        density += w[i] * surface.density[corner[i]];
        position += w[i] * surface.positions[corner[i]];
        if (!surface.uvs.empty()) uv += w[i] * surface.uvs[corner[i]];
    }
    return density > 0.0f && surface.mask ? density * surface.mask(position, uv) : density;
}

double haired_area(const GrowSurface& surface, size_t triangle) {
    const uint32_t* v = &surface.triangles[3 * triangle];
    const glm::dvec3 a(surface.positions[v[0]]);
    const glm::dvec3 ab = glm::dvec3(surface.positions[v[1]]) - a;
    const glm::dvec3 ac = glm::dvec3(surface.positions[v[2]]) - a;
    const double corners = double{surface.density[v[0]]} + double{surface.density[v[1]]} +
                           double{surface.density[v[2]]};
    const double area = 0.5 * glm::length(glm::cross(ab, ac));
    if (!surface.mask || corners == 0.0) return area * corners / 3.0;
    // The middles of the triangles into which its edges' points divide it.
    double sum = 0.0;
    for (int row = 0; row < kMaskRows; ++row) {
        for (int i = 0; i < 2 * row + 1; ++i) {
            const double up = (row + (i % 2 == 0 ? 2.0 : 1.0) / 3.0) / kMaskRows;
            const int pair = i / 2;
            const double along = (pair + (i % 2 == 0 ? 1.0 : 2.0) / 3.0) / kMaskRows;
            sum += density_at(surface, triangle, up - along, along);
        }
    }
    return area * sum / (kMaskRows * kMaskRows);
}

double haired_area(const GrowSurface& surface) {
    double area = 0.0;
    for (size_t t = 0; t < surface.triangle_count(); ++t) area += haired_area(surface, t);
    return area;
}

}  // namespace vellus::hair
