#include <algorithm>

#include "assets/generator/fox.h"
#include "assets/generator/random.h"
#include "assets/generator/sdf.h"

// Roots are spread over the mesh's triangles by area and by how much fur a place calls for; each
// hair leaves the skin at a slant, is combed from nose to tail and down the legs, and bends along
// the skin.
namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr int kFurPoints = 4;
constexpr uint32_t kHairs = 13'000;

/// Where fur is combed at p, not yet along the skin.
dvec3 comb(dvec3 p) {
    const double side = p.x < 0.0 ? -1.0 : 1.0;
    dvec3 pull(0.0, -0.25, -1.0);
    // Belly and chest hang; legs are combed down.
    pull.y -= 1.3 * smoothstep(0.36, 0.28, p.y);
    pull.y -= 1.5 * smoothstep(0.12, 0.20, p.z) * smoothstep(0.50, 0.44, p.y);
    // From the nose over brow and cheeks.
    const double head = smoothstep(0.47, 0.50, p.y) * smoothstep(0.24, 0.27, p.z);
    const dvec3 face(0.9 * side * smoothstep(0.010, 0.030, std::abs(p.x)), 0.15, -1.0);
    pull = glm::mix(pull, face, head);
    const double ear = smoothstep(0.585, 0.605, p.y);
    return glm::mix(pull, dvec3(0.15 * side, 1.0, -0.15), ear);
}

/// Metres.
double length_at(dvec3 p) {
    const double ax = std::abs(p.x);
    double length = 0.026;
    length = mix(length, 0.046, smoothstep(-0.26, -0.34, p.z));
    length = mix(length, 0.034, smoothstep(0.10, 0.16, p.z) * smoothstep(0.50, 0.45, p.y));
    length = mix(length, 0.010, smoothstep(0.24, 0.14, p.y));
    length = mix(length, 0.0055, smoothstep(0.05, 0.03, p.y));
    const double head = smoothstep(0.47, 0.50, p.y) * smoothstep(0.23, 0.27, p.z);
    double face = mix(0.017, 0.0055, smoothstep(0.320, 0.380, p.z));
    face = mix(face, 0.030, smoothstep(0.050, 0.075, ax) * smoothstep(0.545, 0.515, p.y));
    length = mix(length, face, head);
    return mix(length, 0.009, smoothstep(0.585, 0.605, p.y));
}

/// Hairs for an area: many where they are short; none on eyes and nose.
double density_at(dvec3 p) {
    const double ax = std::abs(p.x);
    const double eye = sphere({ax, p.y, p.z}, {0.0385, 0.5440, 0.3640}, 0.0150);
    const double nose = ellipsoid(p, {0.0, 0.5060, 0.4440}, {0.0140, 0.0115, 0.0110});
    const double wanted = 0.026 / length_at(p);
    return std::min(wanted, 3.2) * smoothstep(0.0015, 0.0030, eye) *
           smoothstep(-0.001, 0.002, nose);
}

struct Area {
    const Surface& surface;
    /// Sum of areas times densities up to and with each triangle.
    std::vector<double> sums;

    explicit Area(const Surface& from) : surface(from) {
        double sum = 0.0;
        for (size_t i = 0; i < surface.indices.size(); i += 3) {
            const dvec3 a = corner(i);
            const dvec3 n = glm::cross(corner(i + 1) - a, corner(i + 2) - a);
            sum += 0.5 * glm::length(n) * density_at((a + corner(i + 1) + corner(i + 2)) / 3.0);
            sums.push_back(sum);
        }
    }
    [[nodiscard]] dvec3 corner(size_t i) const { return surface.positions[surface.indices[i]]; }
};

/// The i-th of `kHairs` roots: its share of the area, jittered, then a place in the triangle.
dvec3 root_of(const Area& area, uint32_t i) {
    const double at = (i + random(i, 121)) / kHairs * area.sums.back();
    const auto found = std::ranges::lower_bound(area.sums, at);
    const auto t = 3 * static_cast<size_t>(found - area.sums.begin());
    double u = random(i, 122);
    double v = random(i, 123);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    const dvec3 a = area.corner(t);
    return a + (area.corner(t + 1) - a) * u + (area.corner(t + 2) - a) * v;
}

Strand hair_at(dvec3 root, uint32_t key) {
    const dvec3 normal = normal_of(fox_skin, root, 1.5e-3);
    const dvec3 jitter(spread(key, 124), spread(key, 125), spread(key, 126));
    // Tufts lean together.
    const dvec3 tuft(noise(root, 0.031, 113), noise(root, 0.037, 114), noise(root, 0.029, 115));
    dvec3 pull = comb(root) + jitter * 0.20 + tuft * 0.30;
    pull = glm::normalize(pull - normal * glm::dot(normal, pull) + dvec3(0.0, -1e-4, 0.0));
    const double length = length_at(root) * (0.72 + 0.5 * random(key, 127));
    const double lift = 0.75 + 0.25 * random(key, 128);
    Strand strand{root};
    dvec3 p = root;
    for (int i = 1; i < kFurPoints; ++i) {
        const double share = static_cast<double>(i - 1) / (kFurPoints - 2);
        p += glm::normalize(normal * mix(lift, 0.12, share) + pull) * (length / (kFurPoints - 1));
        strand.push_back(p);
    }
    return strand;
}

}  // namespace

Fur grow_fox_fur(const SkinnedPart& skin) {
    const Area area(skin.surface);
    Fur fur;
    for (uint32_t i = 0; i < kHairs; ++i) {
        const dvec3 root = root_of(area, i);
        if (density_at(root) < 0.05) {
            continue;
        }
        fur.strands.push_back(hair_at(root, i));
        const dvec3 own = fox_srgb(root) * (0.90 + 0.16 * random(i, 129));
        for (int k = 0; k < kFurPoints; ++k) {
            // Darker at the skin, pale at the tips.
            const double along = static_cast<double>(k) / (kFurPoints - 1);
            fur.colors.emplace_back(glm::min(own * mix(0.82, 1.08, along), dvec3(1.0)), 1.0);
        }
    }
    return fur;
}

}  // namespace vellus::sculpt
