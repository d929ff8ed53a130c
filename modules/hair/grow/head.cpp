#include "modules/hair/grow/head.h"

#include <algorithm>
#include <cmath>

#include "modules/hair/grow/chance.h"

namespace vellus::hair::grow {

namespace {

using glm::dvec3;

/// Solves the symmetric 4x4 system of the sphere fit by elimination with pivots; false if singular.
bool solve(double m[4][5]) {
    for (int column = 0; column < 4; ++column) {
        int pivot = column;
        for (int row = column + 1; row < 4; ++row) {
            if (std::abs(m[row][column]) > std::abs(m[pivot][column])) pivot = row;
        }
        if (std::abs(m[pivot][column]) < 1e-9) return false;
        std::swap(m[pivot], m[column]);
        for (int row = 0; row < 4; ++row) {
            if (row == column) continue;
            const double factor = m[row][column] / m[column][column];
            for (int i = column; i < 5; ++i) m[row][i] -= factor * m[column][i];
        }
    }
    return true;
}

}  // namespace

// |p - c|^2 = r^2 is linear in c and r^2 - |c|^2 (Kasa's fit).
Head fit_head(const std::vector<Root>& roots) {
    if (roots.empty()) return {};
    dvec3 mean(0.0);
    for (const Root& root : roots) mean += root.position / static_cast<double>(roots.size());
    double spread = 0.0;
    for (const Root& root : roots) spread = std::max(spread, glm::distance(root.position, mean));
    const Head rough{mean, std::max(spread, 1e-6)};
    double m[4][5] = {};
    for (const Root& root : roots) {
        const dvec3 q = (root.position - mean) / rough.radius;
        const double row[5] = {2.0 * q.x, 2.0 * q.y, 2.0 * q.z, 1.0, glm::dot(q, q)};
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 5; ++j) {
                m[i][j] += row[i] * row[j] / static_cast<double>(roots.size());
            }
        }
    }
    if (!solve(m)) return rough;
    const dvec3 c(m[0][4] / m[0][0], m[1][4] / m[1][1], m[2][4] / m[2][2]);
    const double squared = m[3][4] / m[3][3] + glm::dot(c, c);
    // A flat patch of skin fits a ball far larger than it is.
    if (!(squared > 0.04) || squared > 4.0) return rough;
    return {mean + c * rough.radius, std::sqrt(squared) * rough.radius};
}

double from_parting(const Head& head, const GrowSettings& settings, dvec3 position) {
    const dvec3 q = (position - head.center) / head.radius;
    const double parting = settings.parting * 0.8;
    const double wobble = 0.012 * wave(2.1 * q.z) + 0.008 * wave(5.3 * q.z + 0.3);
    return q.x - mix(kCrown.x, parting, smoothstep(-0.55, 0.15, q.z)) - wobble;
}

Combed comb(const Head& head, const GrowSettings& settings, const Root& root) {
    const dvec3 q = (root.position - head.center) / head.radius;
    const double from = from_parting(head, settings, root.position);
    const double side = from < 0.0 ? -1.0 : 1.0;
    const double front = smoothstep(-0.60, 0.15, q.z) * settings.parted;
    const dvec3 parted(side, -0.10, -0.22 - 0.5 * smoothstep(0.60, 0.90, q.z));
    dvec3 whirl(1.8 * (q.x - kCrown.x), -0.2, 1.2 * (q.z - kCrown.z));
    whirl.z = std::min(whirl.z, 0.25) - 0.35;
    dvec3 pull = glm::mix(whirl, parted, front);
    // Below the crown hair is combed down.
    pull.y -= 2.2 * smoothstep(0.90, 0.20, q.y) * (1.0 - front);
    const dvec3 along = across(pull, root.normal);
    return {unit(along, unit(across(dvec3(0.0, -1.0, -0.3), root.normal), any_across(root.normal))),
            from};
}

double face_distance(const Head& head, dvec3 p) {
    const dvec3 q = (p - head.center) / head.radius;
    const glm::dvec2 radii(0.66, 1.42);
    const glm::dvec2 flat(q.x, q.y + 0.78);
    const double k0 = glm::length(flat / radii);
    const double k1 = glm::length(flat / (radii * radii));
    const double oval = k1 == 0.0 ? -radii.x : k0 * (k0 - 1.0) / k1;
    // A rounded edge where the oval opens to the front.
    const double opening = 0.42 - q.z;
    const double round = std::max(0.3 - std::abs(oval - opening), 0.0) / 0.3;
    return (std::max(oval, opening) + round * round * 0.3 / 4.0) * head.radius;
}

dvec3 clear_of_face(const Head& head, dvec3 p, double clearance) {
    constexpr int kRounds = 8;
    const double h = 1e-3 * head.radius;
    for (int round = 0; round < kRounds; ++round) {
        const double inside = clearance - face_distance(head, p);
        if (inside <= 0.0) break;
        const dvec3 gradient(
            face_distance(head, p + dvec3(h, 0, 0)) - face_distance(head, p - dvec3(h, 0, 0)),
            face_distance(head, p + dvec3(0, h, 0)) - face_distance(head, p - dvec3(0, h, 0)),
            face_distance(head, p + dvec3(0, 0, h)) - face_distance(head, p - dvec3(0, 0, h)));
        p += unit(gradient, dvec3(1.0, 0.0, 0.0)) * (inside + 1e-3 * head.radius);
    }
    return p;
}

}  // namespace vellus::hair::grow
