#include "assets/generator/hair_style.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "assets/generator/bust.h"
#include "assets/generator/random.h"
#include "assets/generator/scalp.h"
#include "assets/generator/sdf.h"
#include "engine/platform/jobs.h"

// Every strand is traced like falling cord: it leaves the scalp along the parting's comb direction,
// turns towards gravity, and is held off the body and off the face. Strands then gather into locks
// around their neighbours, and locks wave.
namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr double kStep = 0.004;

/// The space before the face that hair is combed around: an upright oval, open to the front, so
/// that it pushes sideways and never forwards.
double face_distance(dvec3 p) {
    const double oval = ellipsoid({p.x, p.y, 0.0}, {0.0, -0.055, 0.0}, {0.0590, 0.1290, 1.0});
    return meet(oval, 0.030 - p.z, 0.03);
}

/// What hair keeps clear of; a strand of an upper layer stays further off the body.
double obstacle(dvec3 p, double layer) {
    const double d = bust_distance(p) - layer;
    return p.z > 0.0 && p.y < 0.10 ? join(d, face_distance(p) - 0.25 * layer, 0.012) : d;
}

/// How far a strand runs over its neighbours: those from the parting lie on top.
double layer_of(const Root& root, uint32_t key) {
    const double top = smoothstep(-0.06, 0.105, root.position.y);
    return 0.0025 + 0.0095 * top + 0.0055 * random(key, 5) + 0.0015 * noise(root.position, 0.03, 7);
}

double length_of(const Root& root, uint32_t key) {
    const double front = smoothstep(0.0, 0.07, root.position.z);
    const double top = smoothstep(-0.08, 0.10, root.position.y);
    const double base = 0.285 + 0.150 * top - 0.045 * front;
    const double shorter = random(key, 6);
    return base * (1.0 - 0.16 * shorter * shorter) * (1.0 + 0.03 * noise(root.position, 0.04, 9));
}

/// Where the next step of a strand wants to go at point p, `s` metres from its root.
dvec3 desired_direction(const Root& root, dvec3 p, double s, double lock) {
    const double combed = 1.0 - smoothstep(0.015, 0.085, s);
    dvec3 pull = root.comb * (1.1 * combed) + dvec3(0.0, -1.0, 0.0) * (1.0 - 0.55 * combed);
    // Beside the face hair is swept back a little; below the chin it parts before and behind the
    // shoulder, by lock.
    const double beside_face = smoothstep(0.015, 0.05, p.z) * smoothstep(-0.11, 0.0, p.y);
    const double side = root.from_parting < 0.0 ? -1.0 : 1.0;
    pull += dvec3(0.22 * side, 0.0, -0.14) * beside_face;
    const double low = smoothstep(-0.06, -0.16, p.y);
    const double split = root.position.z + 0.018 + 0.022 * lock;
    const double away = mix(-0.135, 0.055, saturate(0.5 + split / 0.024));
    pull.z += std::clamp((away - p.z) * 10.0, -0.6, 0.6) * low;
    // Hair hangs together around the neck rather than spreading over the shoulders.
    const double home = 0.064 * std::clamp(root.from_parting / 0.05, -1.0, 1.0);
    pull.x -= 4.0 * smoothstep(0.0, -0.14, p.y) * (p.x - home);
    return glm::normalize(pull);
}

/// A strand as a fine polyline with points kStep apart.
Strand trace(const Root& root, uint32_t key, double length) {
    const double layer = layer_of(root, key);
    const double lock = noise(root.position, 0.035, 11);
    dvec3 p = root.position;
    const double near_parting =
        smoothstep(0.04, 0.0, std::abs(root.from_parting)) * smoothstep(-0.05, 0.0, p.z);
    const double lift = 0.30 + 0.25 * near_parting * smoothstep(0.085, 0.06, p.z);
    dvec3 direction = glm::normalize(root.normal * lift + root.comb * 0.8);
    Strand strand{p};
    double s = 0.0;
    while (s < length) {
        const dvec3 wanted = desired_direction(root, p, s, lock);
        direction = glm::normalize(glm::mix(direction, wanted, 0.16));
        dvec3 next = p + direction * kStep;
        const double held = layer * smoothstep(0.0, 0.055, s + kStep);
        next = push_out([&](dvec3 q) { return obstacle(q, held); }, next, 0.0);
        direction = glm::normalize(next - p);
        p += direction * kStep;
        strand.push_back(p);
        s += kStep;
    }
    return strand;
}

/// `count` points evenly spaced along a polyline.
Strand resample(const Strand& line, int count) {
    Strand result;
    for (int i = 0; i < count; ++i) {
        const double at = static_cast<double>(line.size() - 1) * i / (count - 1);
        const auto segment = std::min(static_cast<size_t>(at), line.size() - 2);
        result.push_back(
            glm::mix(line[segment], line[segment + 1], at - static_cast<double>(segment)));
    }
    return result;
}

/// For every root the nearest of every `stride`-th root: the middle of its lock.
std::vector<uint32_t> nearest_leader(const std::vector<Root>& roots,
                                     const std::vector<uint32_t>& leaders) {
    std::vector<uint32_t> result(roots.size());
    parallel_ranges(roots.size(), 64, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            double best = 1e9;
            for (const uint32_t leader : leaders) {
                // Locks do not reach across the parting.
                const bool same_side =
                    (roots[i].from_parting < 0.0) == (roots[leader].from_parting < 0.0);
                const dvec3 d = roots[i].position - roots[leader].position;
                const double distance = glm::dot(d, d) * (same_side ? 1.0 : 9.0);
                if (distance < best) {
                    best = distance;
                    result[i] = leader;
                }
            }
        }
    });
    return result;
}

std::vector<uint32_t> pick_leaders(size_t roots, double share, uint32_t salt) {
    std::vector<uint32_t> leaders;
    for (uint32_t i = 0; i < roots; ++i) {
        if (random(i, salt) < share) {
            leaders.push_back(i);
        }
    }
    return leaders;
}

/// Pulls a strand towards its leader, more towards the tip.
void gather(Strand& strand, const Strand& leader, double strength, double start) {
    for (size_t i = 0; i < strand.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(strand.size() - 1);
        strand[i] = glm::mix(strand[i], leader[i], strength * smoothstep(start, 0.85, t));
    }
}

/// The wave of a lock: sideways swings that grow towards the tip, alike in neighbouring locks.
void swing(Strand& strand, dvec3 root, uint32_t lock, uint32_t key) {
    const double phase =
        0.35 * noise(root, 0.06, 21) + 0.22 * random(lock, 22) + 0.03 * spread(key, 23);
    const double period = 0.115 + 0.02 * spread(lock, 24);
    const double reach = 0.0078 * (0.75 + 0.5 * random(lock, 25));
    dvec3 out = glm::normalize(dvec3(root.x, 0.0, root.z + 0.02));
    const dvec3 side(-out.z, 0.0, out.x);
    double s = 0.0;
    dvec3 before = strand[0];
    for (Strand::value_type& point : strand) {
        s += glm::distance(point, before);
        before = point;
        const double grown = reach * smoothstep(0.07, 0.26, s);
        point +=
            (side * wave(s / period + phase) + out * 0.6 * wave(s / period + phase + 0.25)) * grown;
    }
}

/// Frizz of the single hair; a few flyaways stand off.
void loosen(Strand& strand, uint32_t key) {
    const bool flyaway = random(key, 31) < 0.025;
    const double reach = flyaway ? 0.011 : 0.0014;
    const dvec3 a(spread(key, 32), 0.4 * spread(key, 33), spread(key, 34));
    const dvec3 b(spread(key, 35), 0.4 * spread(key, 36), spread(key, 37));
    for (size_t i = 0; i < strand.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(strand.size() - 1);
        strand[i] += (a * wave(0.9 * t + random(key, 38)) + b * wave(2.1 * t + random(key, 39))) *
                     (reach * smoothstep(0.03, 0.6, t));
    }
}

void clear_of_body(Strand& strand) {
    for (size_t i = 1; i < strand.size(); ++i) {
        const bool combed = 20 * i > 3 * strand.size();
        const auto field = [&](dvec3 p) {
            const double body = bust_distance(p);
            return combed ? std::min(body, face_distance(p) + 0.0056) : body;
        };
        strand[i] =
            push_out(field, strand[i], 0.0016 * std::min(1.0, static_cast<double>(i) / 2.0));
    }
}

/// Strands to cut away: those that strayed over cheek or throat, or that were pushed into a kink.
bool is_stray(const Strand& strand) {
    for (size_t i = 4; i < strand.size(); ++i) {
        const dvec3 p = strand[i];
        const bool on_cheek = p.z > 0.042 && std::abs(p.y + 0.03) < 0.085 && std::abs(p.x) < 0.061;
        const bool on_throat = p.z > -0.012 && p.y < -0.09 && p.y > -0.225 && std::abs(p.x) < 0.048;
        const dvec3 before = glm::normalize(strand[i - 1] - strand[i - 2]);
        const dvec3 after = glm::normalize(p - strand[i - 1]);
        if (on_cheek || on_throat || glm::dot(before, after) < 0.5) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<Strand> grow_hair(const HairCut& cut) {
    const std::vector<Root> roots = make_roots(cut.directions);
    // As many locks, however many strands are in one.
    const double share = 22'000.0 / cut.directions;
    std::vector<Strand> traced(roots.size());
    parallel_ranges(roots.size(), 32, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const auto key = static_cast<uint32_t>(i);
            const double length = length_of(roots[i], key) * cut.length;
            traced[i] = resample(trace(roots[i], key, length), cut.points);
        }
    });
    const auto locks = nearest_leader(roots, pick_leaders(roots.size(), 0.016 * share, 41));
    const auto wisps = nearest_leader(roots, pick_leaders(roots.size(), 0.10 * share, 42));
    std::vector<Strand> hair(roots.size());
    parallel_ranges(roots.size(), 32, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const auto key = static_cast<uint32_t>(i);
            Strand strand = traced[i];
            gather(strand, traced[wisps[i]], 0.55 * (0.6 + 0.4 * random(key, 43)), 0.10);
            gather(strand, traced[locks[i]], 0.42 * (0.5 + 0.5 * random(key, 44)), 0.25);
            swing(strand, roots[i].position, locks[i], key);
            loosen(strand, key);
            clear_of_body(strand);
            hair[i] = std::move(strand);
        }
    });
    std::erase_if(hair, is_stray);
    return hair;
}

}  // namespace vellus::sculpt
