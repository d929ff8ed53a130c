#include "modules/hair/dynamics/guide_selection.h"

#include <algorithm>
#include <array>
#include <limits>

#include "engine/platform/jobs.h"

namespace vellus::hair {

namespace {

// Guides are chosen among at most so many strands, evenly spaced in the groom's order.
constexpr size_t kMostCandidates = 20'000;
// A guide in the very place of a strand counts as this far, metres.
constexpr float kNearest = 1e-3f;
constexpr float kLeastWeight = 0.05f;

/// Where a strand grows and where it goes; tips count for a third of roots.
struct Feature {
    glm::vec3 root;
    glm::vec3 middle;
    glm::vec3 tip;
};

float distance2(const Feature& a, const Feature& b) {
    const glm::vec3 root = a.root - b.root;
    const glm::vec3 middle = (a.middle - b.middle) - root;
    const glm::vec3 tip = (a.tip - b.tip) - root;
    return glm::dot(root, root) + 0.1f * (glm::dot(middle, middle) + glm::dot(tip, tip));
}

struct Strands {
    std::span<const glm::vec3> points;
    std::span<const uint32_t> begin;

    [[nodiscard]] size_t count() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const glm::vec3> of(size_t strand) const {
        return points.subspan(begin[strand], begin[strand + 1] - begin[strand]);
    }
    [[nodiscard]] Feature feature(size_t strand) const {
        const auto p = of(strand);
        return {p.front(), p[p.size() / 2], p.back()};
    }
    [[nodiscard]] float length(size_t strand) const {
        const auto p = of(strand);
        float sum = 0.0f;
        for (size_t i = 1; i < p.size(); ++i) sum += glm::distance(p[i - 1], p[i]);
        return sum;
    }
};

std::vector<uint32_t> farthest_points(const std::vector<Feature>& features, uint32_t count) {
    const size_t stride = features.size() / kMostCandidates + 1;
    std::vector<uint32_t> candidates;
    for (size_t s = 0; s < features.size(); s += stride) {
        candidates.push_back(static_cast<uint32_t>(s));
    }
    count = std::min(count, static_cast<uint32_t>(candidates.size()));
    std::vector<float> distance(candidates.size(), std::numeric_limits<float>::max());
    std::vector<uint32_t> chosen;
    size_t next = 0;
    while (chosen.size() < count) {
        chosen.push_back(candidates[next]);
        const Feature& from = features[candidates[next]];
        parallel_ranges(candidates.size(), 2048, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                distance[i] = std::min(distance[i], distance2(features[candidates[i]], from));
            }
        });
        next = static_cast<size_t>(std::ranges::max_element(distance) - distance.begin());
    }
    return chosen;
}

/// The three nearest guides, nearest first.
struct Nearest {
    std::array<uint32_t, 3> guide{0, 0, 0};
    std::array<float, 3> distance{};

    Nearest() { distance.fill(std::numeric_limits<float>::max()); }
    void offer(uint32_t index, float d) {
        for (size_t k = 0; k < 3; ++k) {
            if (d >= distance[k]) continue;
            std::swap(d, distance[k]);
            std::swap(index, guide[k]);
        }
    }
};

StrandGuides weigh(const Nearest& nearest, float length, const std::vector<float>& guide_length) {
    StrandGuides follow;
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<size_t>(k);
        const bool there = nearest.distance[at] < std::numeric_limits<float>::max();
        follow.guides[k] = nearest.guide[at];
        follow.weights[k] = there ? 1.0f / (nearest.distance[at] + kNearest * kNearest) : 0.0f;
        sum += follow.weights[k];
    }
    follow.weights /= sum;
    for (int k = 1; k < 3; ++k) {
        if (follow.weights[k] < kLeastWeight) follow.weights[k] = 0.0f;
    }
    follow.weights /= follow.weights.x + follow.weights.y + follow.weights.z;
    for (int k = 0; k < 3; ++k) {
        const float longest = std::max(length, guide_length[follow.guides[k]]);
        follow.reach[k] = longest > 0.0f ? length / longest : 1.0f;
    }
    return follow;
}

/// Distance of the strand's points from those of its first guide, both from their roots, and of
/// the roots.
float spread_of(const Strands& strands, size_t strand, size_t guide) {
    const auto a = strands.of(strand);
    const auto b = strands.of(guide);
    float worst = 0.0f;
    for (size_t i = 0; i < a.size(); ++i) {
        const size_t j = i * (b.size() - 1) / std::max<size_t>(a.size() - 1, 1);
        worst = std::max(worst, glm::distance(a[i], b[j]));
    }
    return worst;
}

}  // namespace

uint32_t default_guide_count(size_t strands) {
    const size_t wanted = std::clamp<size_t>(strands / 24, 64, 4096);
    return static_cast<uint32_t>(std::min(wanted, strands));
}

GuideSelection select_guides(std::span<const glm::vec3> points,
                             std::span<const uint32_t> strand_begin, uint32_t count) {
    GuideSelection selection;
    const Strands strands{points, strand_begin};
    if (strand_begin.size() < 2 || count == 0) return selection;
    std::vector<Feature> features(strands.count());
    for (size_t s = 0; s < features.size(); ++s) features[s] = strands.feature(s);
    selection.guides = farthest_points(features, count);
    std::vector<float> guide_length;
    guide_length.reserve(selection.guides.size());
    for (const uint32_t guide : selection.guides) guide_length.push_back(strands.length(guide));
    selection.follow.resize(strands.count());
    std::vector<float> spread(strands.count());
    parallel_ranges(strands.count(), 64, [&](size_t first, size_t last) {
        for (size_t s = first; s < last; ++s) {
            Nearest nearest;
            for (uint32_t g = 0; g < selection.guides.size(); ++g) {
                nearest.offer(g, distance2(features[s], features[selection.guides[g]]));
            }
            selection.follow[s] = weigh(nearest, strands.length(s), guide_length);
            spread[s] = spread_of(strands, s, selection.guides[nearest.guide[0]]);
        }
    });
    selection.spread = *std::ranges::max_element(spread);
    return selection;
}

}  // namespace vellus::hair
