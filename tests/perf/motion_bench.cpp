#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "engine/platform/clock.h"
#include "modules/hair/dynamics/guide_motion.h"
#include "tests/perf/allocation_count.h"
#include "tests/perf/bench.h"

// What moving guides costs on the processor: a head that shakes, at 60 frames a second.
namespace vellus::bench {

namespace {

using namespace hair;

struct Options {
    std::vector<uint32_t> guides{1000, 2000, 4000, 8000, 16000};
    uint32_t links = kGuideLinks;
    int frames = 60;
};

/// Long hair on half a sphere of a head's size.
GuideSet make_head(uint32_t count, uint32_t links) {
    std::vector<std::vector<glm::vec3>> strands(count);
    for (uint32_t s = 0; s < count; ++s) {
        const double y = (s + 0.5) / count;
        const double a = 2.399963 * s;
        const double across = std::sqrt(1.0 - y * y);
        const glm::dvec3 out(across * std::cos(a), y, across * std::sin(a));
        for (int i = 0; i < 24; ++i) {
            const double t = i / 23.0;
            glm::dvec3 p = 0.09 * out + 0.09 * (1.0 - std::exp(-3.0 * t)) * out;
            p.y -= 0.25 * t * t;
            p.x += 0.005 * t * std::sin(20.0 * t + a);
            strands[s].emplace_back(p);
        }
    }
    return make_guides(strands, links);
}

/// Links as long as at rest within 1 %, and every number finite.
bool sound(const GuideMotion& motion) {
    const GuideSet& guides = motion.guides();
    for (uint32_t g = 0; g < guides.count; ++g) {
        glm::vec3 last(0.0f);
        uint32_t link = 0;
        bool good = true;
        visit_guide_points(guides, motion.state(), g, [&](const glm::vec3& point) {
            const float size = glm::distance(point, last);
            const float rest = guides.length[g] / static_cast<float>(guides.links);
            good =
                good && std::isfinite(size) && (link == 0 || std::abs(size - rest) < 0.3f * rest);
            last = point;
            ++link;
        });
        for (uint32_t i = 0; i < guides.links && good; ++i) {
            double norm = 0.0;
            for (uint32_t c = 0; c < 4; ++c) {
                const double q = static_cast<double>(motion.state().rotation.at(c, i)[g]);
                norm += q * q;
            }
            // A link is its rest turned by a quaternion, so its length is off by that one's norm.
            good = std::abs(norm - 1.0) < 0.01;
        }
        if (!good) return false;
    }
    return true;
}

struct Cost {
    double cpu_ms = 1e9;
    double wall_ms = 1e9;
    uint64_t allocations = 0;
    bool sound = true;
};

Cost measure(uint32_t count, bool colliders, const Options& options) {
    GuideMotion motion(make_head(count, options.links));
    std::vector<RootPose> roots(count);
    std::vector<WorldCapsule> capsules;
    if (colliders) {
        capsules = {{glm::dvec3(0.0), glm::dvec3(0.0), 0.088, 1},
                    {{-0.15, -0.25, 0.0}, {0.15, -0.25, 0.0}, 0.06, 2}};
    }
    Cost cost;
    for (int frame = 0; frame < options.frames + 2; ++frame) {
        const double t = frame / 60.0;
        const glm::dquat turn =
            glm::angleAxis(0.9 * std::sin(2.0 * std::numbers::pi * t), glm::dvec3(0, 1, 0));
        for (uint32_t g = 0; g < count; ++g) {
            roots[g] = {turn * glm::dvec3(motion.guides().root[g]), turn};
        }
        const uint64_t allocated = allocations();
        const double wall = wall_seconds();
        const double cpu = process_cpu_seconds();
        motion.advance({}, {.dt = 1.0 / 60.0, .time = t, .roots = roots, .capsules = capsules});
        if (frame >= 2) {
            cost.cpu_ms = std::min(cost.cpu_ms, (process_cpu_seconds() - cpu) * 1e3);
            cost.wall_ms = std::min(cost.wall_ms, (wall_seconds() - wall) * 1e3);
            cost.allocations += allocations() - allocated;
        }
        cost.sound = cost.sound && sound(motion);
    }
    return cost;
}

int run(const Options& options) {
    fmt::print("motion: guides of {} points, 4 steps of 1/240 s a frame, least of {} frames\n",
               options.links + 1, options.frames);
    fmt::print("{:>8} {:>10} {:>10} {:>10} {:>12} {:>18}\n", "guides", "colliders", "CPU ms",
               "wall ms", "us a guide", "allocations");
    bool good = true;
    for (const bool colliders : {false, true}) {
        for (const uint32_t count : options.guides) {
            const Cost cost = measure(count, colliders, options);
            fmt::print("{:>8} {:>10} {:>10.2f} {:>10.2f} {:>12.2f} {:>18}\n", count,
                       colliders ? 2 : 0, cost.cpu_ms, cost.wall_ms, cost.cpu_ms * 1e3 / count,
                       cost.allocations);
            good = good && cost.sound;
        }
    }
    if (!good) fmt::print("a link is not finite, or longer or shorter than at rest by 1 %\n");
    return good ? 0 : 1;
}

const Registration kMotion(
    {"motion", "Moving guides on the processor, by number of guides", [](CLI::App& app) {
         auto options = std::make_shared<Options>();
         app.add_option("--guides", options->guides, "Numbers of guides");
         app.add_option("--links", options->links, "Links of each")
             ->check(CLI::Range(1, hair::glsl::kRodMaxLinks));
         app.add_option("--frames", options->frames, "Frames measured")->check(CLI::PositiveNumber);
         return [options] { return run(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
