#include "assets/generator/skeleton.h"

#include <algorithm>
#include <cmath>

namespace vellus::sculpt {

namespace {

using glm::dvec3;

/// Orthonormal axes whose Y runs along `along` and whose X is as close to `hinge` as that allows.
glm::dmat3 axes(dvec3 along, dvec3 hinge) {
    const dvec3 y = glm::normalize(along);
    const dvec3 x = glm::normalize(hinge - y * glm::dot(hinge, y));
    return {x, y, glm::cross(x, y)};
}

}  // namespace

Pose rest_pose(std::span<const Joint> joints) {
    return {std::vector<glm::dquat>(joints.size(), glm::dquat(1.0, 0.0, 0.0, 0.0)),
            joints[0].position};
}

std::vector<Frame> frames_of(std::span<const Joint> joints, const Pose& pose) {
    std::vector<Frame> frames;
    for (size_t j = 0; j < joints.size(); ++j) {
        if (joints[j].parent < 0) {
            frames.push_back({pose.rotations[j], pose.root});
            continue;
        }
        const auto p = static_cast<size_t>(joints[j].parent);
        const Frame& parent = frames[p];
        frames.push_back(
            {parent.rotation * pose.rotations[j],
             parent.position + parent.rotation * (joints[j].position - joints[p].position)});
    }
    return frames;
}

Influences strongest(std::span<const double> shares) {
    std::vector<uint8_t> order(shares.size());
    for (size_t j = 0; j < order.size(); ++j) {
        order[j] = static_cast<uint8_t>(j);
    }
    std::ranges::stable_sort(order, [&](uint8_t a, uint8_t b) { return shares[a] > shares[b]; });
    Influences result;
    double sum = 0.0;
    for (size_t i = 0; i < 4 && shares[order[i]] > 1e-4; ++i) {
        result.joints[i] = order[i];
        result.weights[i] = shares[order[i]];
        sum += shares[order[i]];
    }
    for (double& weight : result.weights) {
        weight /= sum;
    }
    return result;
}

std::vector<double> shares_down(std::span<const Joint> joints, std::span<const double> passed_on) {
    std::vector<double> asked(joints.size(), 0.0);
    for (size_t j = 1; j < joints.size(); ++j) {
        asked[static_cast<size_t>(joints[j].parent)] += passed_on[j];
    }
    std::vector<double> shares(joints.size(), 0.0);
    shares[0] = 1.0;
    std::vector<double> held = shares;
    for (size_t j = 1; j < joints.size(); ++j) {
        const auto parent = static_cast<size_t>(joints[j].parent);
        held[j] = held[parent] * passed_on[j] / std::max(1.0, asked[parent]);
        shares[j] = held[j];
        shares[parent] -= held[j];
    }
    for (double& share : shares) {
        share = std::max(share, 0.0);
    }
    return shares;
}

dvec3 skinned(std::span<const Joint> joints, std::span<const Frame> frames,
              const Influences& influences, dvec3 point) {
    dvec3 sum(0.0);
    for (size_t i = 0; i < 4; ++i) {
        const uint8_t j = influences.joints[i];
        sum += (frames[j].position + frames[j].rotation * (point - joints[j].position)) *
               influences.weights[i];
    }
    return sum;
}

Limb reach(const std::array<dvec3, 3>& rest, dvec3 from, dvec3 to, dvec3 pole) {
    const double upper = glm::distance(rest[0], rest[1]);
    const double lower = glm::distance(rest[1], rest[2]);
    const dvec3 along = glm::normalize(to - from);
    const double length = std::clamp(glm::distance(from, to), std::abs(upper - lower) * 1.001,
                                     (upper + lower) * 0.9999);
    const double cosine = (upper * upper + length * length - lower * lower) / (2 * upper * length);
    const dvec3 bent = glm::normalize(pole - along * glm::dot(pole, along));
    const dvec3 middle = from + along * (upper * cosine) +
                         bent * (upper * std::sqrt(std::max(0.0, 1.0 - cosine * cosine)));
    const dvec3 hinge = glm::cross(bent, along);
    const dvec3 rest_hinge(1.0, 0.0, 0.0);
    const dvec3 end = from + along * length;
    const auto turn = [&](dvec3 rest_bone, dvec3 bone) {
        return glm::normalize(
            glm::quat_cast(axes(bone, hinge) * glm::transpose(axes(rest_bone, rest_hinge))));
    };
    return {turn(rest[1] - rest[0], middle - from), turn(rest[2] - rest[1], end - middle)};
}

}  // namespace vellus::sculpt
