#include "modules/hair/grow/shape.h"

#include <algorithm>
#include <cmath>

#include "engine/platform/jobs.h"
#include "modules/hair/grow/chance.h"

namespace vellus::hair::grow {

namespace {

using glm::dvec3;

constexpr size_t kStrandsPerJob = 64;
/// Wisps to a lock.
constexpr double kWisps = 7.0;
/// Fewest points to a turn of curl: fewer would turn curls into zigzags.
constexpr double kPointsPerTurn = 6.0;

/// For every root the nearest of the first `count`; across the parting counts as further.
std::vector<uint32_t> nearest_of_first(const std::vector<Root>& roots,
                                       const std::vector<double>& from_parting, size_t count) {
    std::vector<uint32_t> result(roots.size());
    parallel_ranges(roots.size(), kStrandsPerJob, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            double best = 1e30;
            for (uint32_t leader = 0; leader < count; ++leader) {
                const dvec3 d = roots[leader].position - roots[i].position;
                const bool other_side = (from_parting[leader] < 0.0) != (from_parting[i] < 0.0);
                const double far = glm::dot(d, d) * (other_side ? 9.0 : 1.0);
                if (far >= best) continue;
                best = far;
                result[i] = leader;
            }
        }
    });
    return result;
}

double share_along(size_t p, size_t points) {
    return static_cast<double>(p) / static_cast<double>(points - 1);
}

/// A frame carried along a strand with the least turn (double reflection, Wang et al. 2008).
struct Transport {
    dvec3 tangent;
    dvec3 side;

    void move(dvec3 step, dvec3 next_tangent) {
        const double squared = glm::dot(step, step);
        if (!(squared > 0.0)) return;
        const dvec3 s = side - step * (2.0 / squared * glm::dot(step, side));
        const dvec3 t = tangent - step * (2.0 / squared * glm::dot(step, tangent));
        const dvec3 turn = next_tangent - t;
        const double turned = glm::dot(turn, turn);
        side = turned > 1e-24 ? s - turn * (2.0 / turned * glm::dot(turn, s)) : s;
        side = unit(across(side, next_tangent), any_across(next_tangent));
        tangent = next_tangent;
    }
};

class Shaper {
  public:
    Shaper(const Ground& ground, const Locks& locks, const std::vector<Root>& roots, bool gathered,
           Strands& strands)
        : ground_(ground), locks_(locks), roots_(roots), gathered_(gathered), strands_(strands) {}

    void shape(size_t i) {
        const size_t points = strands_.points;
        line_.assign(strands_.strand(i), strands_.strand(i) + points);
        if (ground_.settings.curl > 0.0f) curl(i);
        if (ground_.settings.frizz > 0.0f) loosen(i);
        settle(i);
        for (size_t p = 1; p < points; ++p) strands_.strand(i)[p] = glm::vec3(line_[p]);
    }

  private:
    [[nodiscard]] double random_of(size_t i, uint32_t salt) const {
        return random(ground_.seed, static_cast<uint32_t>(i), salt);
    }
    [[nodiscard]] double spread_of(size_t i, uint32_t salt) const {
        return spread(ground_.seed, static_cast<uint32_t>(i), salt);
    }

    /// Winds the strand around its middle line; curls of a lock go together.
    void curl(size_t i) {
        const GrowSettings& settings = ground_.settings;
        const size_t points = line_.size();
        const size_t lock = locks_.lock[i];
        const double step = length_of(line_) / static_cast<double>(points - 1);
        const bool flat = settings.style == GrowStyle::kWavy;
        const double varied = flat ? 0.05 : 0.18;
        const double period = std::max(settings.curl_period * (1.0 + varied * spread_of(lock, 81)),
                                       kPointsPerTurn * step);
        // Waves lie side by side at one height, as fingers press them; curls start as they like.
        const dvec3 from_middle = roots_[lock].position - ground_.head.center;
        const double start =
            flat ? 0.18 * noise(from_middle, ground_.head.radius, ground_.seed, 87) -
                       from_middle.y / period
                 : random_of(lock, 82);
        const double phase = start + (flat ? 0.04 : 0.10) * spread_of(i, 83);
        const double radius =
            settings.curl * (1.0 + 0.25 * spread_of(lock, 84)) * (1.0 + 0.15 * spread_of(i, 85));
        const double hand = flat || random_of(lock, 86) < 0.5 ? 1.0 : -1.0;
        Transport frame{unit(line_[1] - line_[0], roots_[i].normal), {}};
        frame.side = unit(across(roots_[i].normal, frame.tangent), any_across(frame.tangent));
        const double grown_at = settings.style == GrowStyle::kCoily ? 0.010 : 0.055;
        const double scale = ground_.head.radius / 0.09;
        double s = 0.0;
        dvec3 before = line_[0];
        for (size_t p = 1; p < points; ++p) {
            const dvec3 here = line_[p];
            const dvec3 ahead = p + 1 < points ? line_[p + 1] - here : here - before;
            frame.move(here - before, unit(ahead, frame.tangent));
            s += glm::distance(here, before);
            before = here;
            const double turns = hand * s / period + phase;
            const dvec3 other = glm::cross(frame.tangent, frame.side);
            const double depth = flat ? 0.35 : 1.0;
            // Zero at the root, so that roots stay where they are.
            line_[p] += (other * wave(turns) + frame.side * (depth * wave(turns + 0.25))) *
                        (radius * smoothstep(0.0, grown_at * scale, s));
        }
    }

    void loosen(size_t i) {
        const GrowSettings& settings = ground_.settings;
        const double length = length_of(line_);
        const bool flyaway = random_of(i, 31) < settings.flyaways;
        const double most = std::min(0.0065 * ground_.head.radius / 0.09, 0.06 * length);
        const double reach = settings.frizz * most * (flyaway ? 8.0 : 1.0);
        const dvec3 a(spread_of(i, 32), 0.4 * spread_of(i, 33), spread_of(i, 34));
        const dvec3 b(spread_of(i, 35), 0.4 * spread_of(i, 36), spread_of(i, 37));
        for (size_t p = 1; p < line_.size(); ++p) {
            const double t = share_along(p, line_.size());
            const double grown =
                reach * smoothstep(0.02, 0.7, t) * (gathered_ && !flyaway ? 0.35 : 1.0);
            line_[p] +=
                (a * wave(0.9 * t + random_of(i, 38)) + b * wave(2.1 * t + random_of(i, 39))) *
                grown;
        }
    }

    void settle(size_t i) {
        const double radius = ground_.head.radius;
        const double most =
            0.0016 * radius / 0.09 * std::min(1.0f, ground_.settings.length / 0.03f);
        const bool keeps_face = ground_.settings.face > 0.0f && !gathered_;
        for (size_t p = 1; p < line_.size(); ++p) {
            const double clearance =
                most * std::min(1.0, static_cast<double>(p) / 2.0) * (0.5 + 0.5 * random_of(i, 41));
            // Blended from guides on both sides of the head, a strand may run deep inside it.
            line_[p] = ground_.body.push_out(line_[p], clearance, radius);
            if (!keeps_face || p <= 3) continue;
            const double beside = -0.06 * radius - (1.0 - ground_.settings.face) * 0.7 * radius;
            const dvec3 clear = clear_of_face(ground_.head, line_[p], beside);
            if (clear != line_[p]) line_[p] = ground_.body.push_out(clear, clearance, radius);
        }
    }

    const Ground& ground_;
    const Locks& locks_;
    const std::vector<Root>& roots_;
    bool gathered_;
    Strands& strands_;
    Line line_;
};

}  // namespace

Locks find_locks(const GrowSettings& settings, double area, const std::vector<Root>& roots,
                 const std::vector<double>& from_parting) {
    const double count = area / (0.866 * settings.clump_size * settings.clump_size);
    const auto whole = [&](double n) {
        return std::clamp(static_cast<size_t>(std::min(n, 3e4)), size_t{1}, roots.size());
    };
    return {nearest_of_first(roots, from_parting, whole(count)),
            nearest_of_first(roots, from_parting, whole(kWisps * count))};
}

void clump(const Ground& ground, const Locks& locks, Strands& strands) {
    const double strength = ground.settings.clumping;
    if (strength <= 0.0) return;
    const Strands before = strands;
    parallel_ranges(strands.count(), kStrandsPerJob, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const auto key = static_cast<uint32_t>(i);
            const double to_wisp = strength * (0.75 + 0.25 * random(ground.seed, key, 43));
            const double to_lock = strength * (0.45 + 0.40 * random(ground.seed, key, 44));
            const glm::vec3* wisp = before.strand(locks.wisp[i]);
            const glm::vec3* lock = before.strand(locks.lock[i]);
            glm::vec3* out = strands.strand(i);
            for (size_t p = 1; p < strands.points; ++p) {
                const double t = share_along(p, strands.points);
                dvec3 at =
                    glm::mix(dvec3(out[p]), dvec3(wisp[p]), to_wisp * smoothstep(0.05, 0.7, t));
                at = glm::mix(at, dvec3(lock[p]), to_lock * smoothstep(0.20, 0.95, t));
                out[p] = glm::vec3(at);
            }
        }
    });
}

void curl_and_settle(const Ground& ground, const Locks& locks, const std::vector<Root>& roots,
                     bool gathered, Strands& strands) {
    parallel_ranges(strands.count(), kStrandsPerJob, [&](size_t first, size_t last) {
        Shaper shaper(ground, locks, roots, gathered, strands);
        for (size_t i = first; i < last; ++i) shaper.shape(i);
    });
}

}  // namespace vellus::hair::grow
