#include "modules/hair/grow/strands.h"

#include <algorithm>
#include <cmath>

#include "engine/platform/jobs.h"
#include "modules/hair/grow/chance.h"

namespace vellus::hair::grow {

namespace {

using glm::dvec3;

constexpr size_t kStrandsPerJob = 64;

/// Position of guide `guide` at share t of its length.
dvec3 at(const Guide& guide, double t) {
    const double along = saturate(t) * static_cast<double>(kGuidePoints - 1);
    const auto i = std::min(static_cast<size_t>(along), kGuidePoints - 2);
    return glm::mix(guide.line[i], guide.line[i + 1], along - static_cast<double>(i));
}

struct Blend {
    const std::vector<Guide>& guides;
    const Neighbours& near;

    [[nodiscard]] dvec3 position(double t) const {
        dvec3 p(0.0);
        for (size_t i = 0; i < near.guide.size(); ++i) {
            p += at(guides[near.guide[i]], t) * near.weight[i];
        }
        return p;
    }
    [[nodiscard]] double length() const {
        double length = 0.0;
        for (size_t i = 0; i < near.guide.size(); ++i) {
            length += guides[near.guide[i]].length * near.weight[i];
        }
        return length;
    }
};

/// Share of its full length that a hair has.
double share_of(const Ground& ground, uint32_t key) {
    const double shorter = random(ground.seed, key, 6);
    return 1.0 - ground.settings.length_variation * shorter * shorter;
}

/// Where a hair lies in the tail's cross-section: hair from the left comes in on the left.
glm::dvec2 place_of(const Ground& ground, const Gather& gather, const Root& root, uint32_t key) {
    const Gather::Frame frame = gather.at(0.0);
    const dvec3 from = root.position - gather.band;
    const glm::dvec2 flat(glm::dot(from, frame.left), glm::dot(from, frame.back));
    const double length = glm::length(flat);
    const glm::dvec2 own(spread(ground.seed, key, 71), spread(ground.seed, key, 72));
    const glm::dvec2 direction = (length > 0.0 ? flat / length : glm::dvec2(0.0)) * 0.6 + own;
    const double norm = glm::length(direction);
    return (norm > 0.0 ? direction / norm : glm::dvec2(1.0, 0.0)) *
           std::sqrt(random(ground.seed, key, 73));
}

Line gathered_line(const Ground& ground, const Root& root, uint32_t key, const Blend& blend,
                   const Gather& gather) {
    constexpr size_t kScalpPoints = 24;
    const glm::dvec2 place = place_of(ground, gather, root, key);
    const dvec3 own = root.position - blend.position(0.0);
    Line line;
    const dvec3 entry = tail_point(gather, ground.settings, place, 0.0, 1.0) - gather.band;
    for (size_t i = 0; i < kScalpPoints; ++i) {
        const double t = static_cast<double>(i) / kScalpPoints;
        line.push_back(blend.position(t) + own * (1.0 - smoothstep(0.25, 1.0, t)) +
                       entry * smoothstep(0.35, 1.0, t));
    }
    const double end = ground.settings.length * share_of(ground, key);
    const auto steps = static_cast<size_t>(std::max(8.0, end / gather.step));
    for (size_t i = 0; i <= steps; ++i) {
        const double s = end * static_cast<double>(i) / static_cast<double>(steps);
        line.push_back(tail_point(gather, ground.settings, place, s, end));
    }
    return line;
}

}  // namespace

std::vector<Neighbours> find_neighbours(const std::vector<Root>& roots,
                                        const std::vector<double>& from_parting,
                                        size_t guide_count) {
    std::vector<Neighbours> result(roots.size());
    parallel_ranges(roots.size(), kStrandsPerJob, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            std::array<double, 3> nearest;
            nearest.fill(1e30);
            std::array<uint32_t, 3> which{};
            for (uint32_t g = 0; g < guide_count; ++g) {
                const dvec3 d = roots[g].position - roots[i].position;
                const bool other_side = (from_parting[g] < 0.0) != (from_parting[i] < 0.0);
                const double turned =
                    1.0 - std::min(glm::dot(roots[g].normal, roots[i].normal), 1.0);
                const double far = glm::dot(d, d) * (other_side ? 9.0 : 1.0) * (1.0 + 8.0 * turned);
                if (far >= nearest[2]) continue;
                size_t at = 2;
                for (; at > 0 && far < nearest[at - 1]; --at) {
                    nearest[at] = nearest[at - 1];
                    which[at] = which[at - 1];
                }
                nearest[at] = far;
                which[at] = g;
            }
            Neighbours& found = result[i];
            found.guide = which;
            // The third neighbour's weight fades as a fourth would come as near: use it as scale.
            const double scale = std::min(nearest[2], 1e29) * 0.05 + 1e-18;
            double sum = 0.0;
            for (size_t k = 0; k < 3; ++k) {
                found.weight[k] = nearest[k] < 1e29 ? 1.0 / (nearest[k] + scale) : 0.0;
                sum += found.weight[k];
            }
            for (double& weight : found.weight) weight /= sum;
        }
    });
    return result;
}

Strands interpolate(const Ground& ground, const std::vector<Root>& roots,
                    const std::vector<Guide>& guides, const std::vector<Neighbours>& neighbours,
                    const std::optional<Gather>& gather) {
    Strands strands{.points = ground.settings.points};
    strands.at.resize(roots.size() * strands.points);
    // The middle line of a curl is shorter than the hair.
    const double turn = 6.283185307179586 * ground.settings.curl / ground.settings.curl_period;
    const double wound = 1.0 / std::sqrt(1.0 + turn * turn);
    parallel_ranges(roots.size(), kStrandsPerJob, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const auto key = static_cast<uint32_t>(i);
            const Blend blend{guides, neighbours[i]};
            glm::vec3* out = strands.strand(i);
            if (gather) {
                const Line line =
                    resample(gathered_line(ground, roots[i], key, blend, *gather), strands.points);
                for (size_t p = 0; p < strands.points; ++p) out[p] = glm::vec3(line[p]);
                continue;
            }
            const double share = share_of(ground, key) * wound;
            const dvec3 own = roots[i].position - blend.position(0.0);
            for (size_t p = 0; p < strands.points; ++p) {
                const double t = static_cast<double>(p) / static_cast<double>(strands.points - 1);
                out[p] = glm::vec3(blend.position(t * share) + own);
            }
        }
    });
    return strands;
}

}  // namespace vellus::hair::grow
