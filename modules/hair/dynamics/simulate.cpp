#include "modules/hair/dynamics/simulate.h"

#include <array>
#include <cassert>
#include <cstring>

#include "engine/platform/jobs.h"

namespace vellus::hair::lanes {

namespace {

rvec3 mix(const glm::vec3& a, const glm::vec3& b, float t) {
    const glm::vec3 m = a + (b - a) * t;
    return rod_spread(m);
}

/// Four guides; the members are what rod_step.glsl asks for.
struct GuideLanes {
    const GuideSet& guides;
    const glsl::RodParams& rod_params;
    std::span<const glsl::RodCapsule> capsules;
    GuideState& state;
    uint32_t first_guide;

    int rod_links = 0;
    uint32_t rod_near = 0;
    rvec4 rod_turn{};
    rvec4 rod_spin{};
    rvec3 rod_place0{};
    rvec3 rod_place1{};
    std::array<rvec3, kRodMaxLinks> rod_olds{};
    std::array<rvec3, kRodMaxLinks> rod_offsets{};
    std::array<rvec3, kRodMaxLinks> rod_spins{};
    std::array<rvec3, kRodMaxLinks> rod_forces{};
    std::array<RodGain, kRodMaxLinks> rod_gains{};

    real load(const GuideColumns& columns, uint32_t component, int link) const {
        real value;
        std::memcpy(&value.v, columns.at(component, static_cast<uint32_t>(link)) + first_guide,
                    sizeof value.v);
        return value;
    }
    void store(GuideColumns& columns, uint32_t component, int link, real value) const {
        std::memcpy(columns.at(component, static_cast<uint32_t>(link)) + first_guide, &value.v,
                    sizeof value.v);
    }
    rvec3 load3(const GuideColumns& columns, int link) const {
        return {load(columns, 0, link), load(columns, 1, link), load(columns, 2, link)};
    }

    rvec3 rod_rest(int i) const { return load3(guides.rest, i); }
    rvec3 rod_preload(int i) const { return load3(guides.preload, i); }
    rvec3 rod_velocity(int i) const { return load3(state.velocity, i); }
    real rod_tension(int i) const { return load(state.tension, 0, i); }
    rvec4 rod_rotation(int i) const {
        return {load(state.rotation, 0, i), load(state.rotation, 1, i), load(state.rotation, 2, i),
                load(state.rotation, 3, i)};
    }
    void rod_set_velocity(int i, rvec3 v) {
        store(state.velocity, 0, i, v.x);
        store(state.velocity, 1, i, v.y);
        store(state.velocity, 2, i, v.z);
    }
    void rod_set_tension(int i, real t) { store(state.tension, 0, i, t); }
    void rod_set_rotation(int i, rvec4 q) {
        store(state.rotation, 0, i, q.x);
        store(state.rotation, 1, i, q.y);
        store(state.rotation, 2, i, q.z);
        store(state.rotation, 3, i, q.w);
    }
    RodCapsuleStep rod_capsule(int c, float begin, float end) const {
        const glsl::RodCapsule& capsule = capsules[static_cast<size_t>(c)];
        RodCapsuleStep now;
        now.a = mix(capsule.a0, capsule.a1, end);
        now.b = mix(capsule.b0, capsule.b1, end);
        now.a_travel = rod_spread((capsule.a1 - capsule.a0) * (end - begin));
        now.b_travel = rod_spread((capsule.b1 - capsule.b0) * (end - begin));
        now.radius = capsule.radius;
        return now;
    }
    void take_roots(std::span<const glsl::RodRoot> roots) {
        const auto gather = [&](const auto& field) {
            real value;
            for (uint32_t lane = 0; lane < kRodLanes; ++lane) {
                // Lanes beyond the last guide have links of no length; any root will do.
                value.v[lane] =
                    field(roots[std::min<size_t>(first_guide + lane, roots.size() - 1)]);
            }
            return value;
        };
        const auto turn = [&](glm::vec4 glsl::RodRoot::*q) {
            return rvec4(gather([q](const auto& r) { return (r.*q).x; }),
                         gather([q](const auto& r) { return (r.*q).y; }),
                         gather([q](const auto& r) { return (r.*q).z; }),
                         gather([q](const auto& r) { return (r.*q).w; }));
        };
        const auto place = [&](glm::vec3 glsl::RodRoot::*p) {
            return rvec3(gather([p](const auto& r) { return (r.*p).x; }),
                         gather([p](const auto& r) { return (r.*p).y; }),
                         gather([p](const auto& r) { return (r.*p).z; }));
        };
        rod_turn = turn(&glsl::RodRoot::turn);
        rod_spin = turn(&glsl::RodRoot::spin);
        rod_place0 = place(&glsl::RodRoot::place0);
        rod_place1 = place(&glsl::RodRoot::place1);
    }

#include "hair/dynamics/rod_step.glsl"
};

}  // namespace

}  // namespace vellus::hair::lanes

namespace vellus::hair {

void simulate(const GuideSet& guides, const glsl::RodParams& params,
              std::span<const glsl::RodRoot> roots, std::span<const glsl::RodCapsule> capsules,
              GuideState& state) {
    assert(roots.size() == guides.count);
    assert(params.capsules == capsules.size() && capsules.size() <= 32);
    if (guides.count == 0 || params.substeps == 0) return;
    parallel_ranges(guides.stride / kRodLanes, 4, [&](size_t begin, size_t end) {
        for (size_t group = begin; group < end; ++group) {
            lanes::GuideLanes work{guides, params, capsules, state,
                                   static_cast<uint32_t>(group * kRodLanes)};
            work.rod_links = static_cast<int>(guides.links);
            work.take_roots(roots);
            work.rod_frame();
        }
    });
}

}  // namespace vellus::hair
