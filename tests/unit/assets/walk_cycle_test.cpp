#include "assets/generator/walk_cycle.h"

#include <gtest/gtest.h>

#include "assets/generator/figure.h"
#include "assets/generator/figure_mesh.h"
#include "assets/generator/trigonometry.h"
#include "assets/generator/walk_scene.h"

namespace vellus::sculpt {
namespace {

constexpr int kKeys = 32;

/// What a player shows between two keys of the clip: each joint on the arc between its turns.
Pose played(const Gait& gait, double phase) {
    const double at = (phase - std::floor(phase)) * kKeys;
    const double key = std::floor(at);
    Pose pose = walk_pose(gait, key / kKeys);
    const Pose next = walk_pose(gait, (key + 1.0) / kKeys);
    for (size_t j = 0; j < pose.rotations.size(); ++j) {
        pose.rotations[j] = glm::slerp(pose.rotations[j], next.rotations[j], at - key);
    }
    pose.root = glm::mix(pose.root, next.root, at - key);
    return pose;
}

const SkinnedPart& shoes() {
    static const SkinnedPart part = sculpt_part(figure_recipes(false)[3]);
    return part;
}

TEST(Trigonometry, SineAgreesWithTheLibrary) {
    for (int i = -500; i <= 500; ++i) {
        const double turns = i * 0.0137;
        EXPECT_NEAR(sine(turns), std::sin(turns * 6.283185307179586), 2e-14);
        EXPECT_NEAR(cosine(turns), std::cos(turns * 6.283185307179586), 2e-14);
    }
}

TEST(WalkCycle, RepeatsItself) {
    for (const Gait& gait : {Gait{}, lap_gait()}) {
        for (const double phase : {0.0, 0.21, 0.62, 0.9}) {
            const Pose a = walk_pose(gait, phase);
            const Pose b = walk_pose(gait, phase + 1.0);
            EXPECT_LT(glm::distance(a.root, b.root), 1e-12);
            for (size_t j = 0; j < a.rotations.size(); ++j) {
                EXPECT_GT(std::abs(glm::dot(a.rotations[j], b.rotations[j])), 1.0 - 1e-12);
            }
        }
    }
}

TEST(WalkCycle, HasNoJumps) {
    for (const Gait& gait : {Gait{}, lap_gait()}) {
        for (int i = 0; i < 512; ++i) {
            const Pose a = walk_pose(gait, i / 512.0);
            const Pose b = walk_pose(gait, (i + 1) / 512.0);
            for (size_t j = 0; j < a.rotations.size(); ++j) {
                const double cosine =
                    std::min(1.0, std::abs(glm::dot(a.rotations[j], b.rotations[j])));
                // 2 ms: no joint turns faster than 1000 degrees a second.
                EXPECT_LT(2.0 * std::acos(cosine) * 57.3, 2.1) << figure_joints()[j].name << i;
            }
        }
    }
}

TEST(WalkCycle, SecondStepMirrorsTheFirst) {
    const auto mirrored = [](glm::dvec3 p) { return glm::dvec3(-p.x, p.y, p.z); };
    for (const double phase : {0.05, 0.3, 0.47}) {
        const auto a = frames_of(figure_joints(), walk_pose({}, phase));
        const auto b = frames_of(figure_joints(), walk_pose({}, phase + 0.5));
        for (const auto& [left, right] :
             {std::pair(kLeftHand, kRightHand), {kLeftFoot, kRightFoot}, {kHead, kHead}}) {
            EXPECT_LT(glm::distance(a[left].position, mirrored(b[right].position)), 1e-9);
        }
    }
}

TEST(WalkCycle, ShoesNeitherSinkNorSlide) {
    for (const Gait& gait : {Gait{}, lap_gait()}) {
        // Where each vertex last came down, carried along with the ground.
        std::vector<glm::dvec3> planted(shoes().surface.positions.size());
        std::vector<bool> down(planted.size(), false);
        constexpr int kSteps = 128;
        double lowest = 1.0;
        double slid = 0.0;
        for (int step = 0; step < 2 * kSteps; ++step) {
            const auto frames = frames_of(figure_joints(), played(gait, step * 1.0 / kSteps));
            double ground = 1.0;
            for (size_t v = 0; v < planted.size(); ++v) {
                const glm::dvec3 p = skinned(figure_joints(), frames, shoes().influences[v],
                                             shoes().surface.positions[v]);
                ground = std::min(ground, p.y);
                planted[v] = ground_after(gait, planted[v], 1.0 / kSteps);
                const bool touches = p.y < 0.002;
                if (touches && down[v]) {
                    slid = std::max(
                        slid, glm::length(glm::dvec2(p.x - planted[v].x, p.z - planted[v].z)));
                } else if (touches) {
                    planted[v] = p;
                }
                down[v] = touches;
            }
            lowest = std::min(lowest, ground);
            // One foot always carries.
            EXPECT_LT(ground, 0.008) << step;
        }
        EXPECT_GT(lowest, -0.006);
        EXPECT_LT(slid, 0.010);
    }
}

TEST(WalkCycle, IdleFeetStayWhereTheyAre) {
    const auto rest = frames_of(figure_joints(), idle_pose(0.0));
    for (int i = 1; i <= 16; ++i) {
        const auto frames = frames_of(figure_joints(), idle_pose(i / 16.0));
        for (const int foot : {kLeftFoot, kRightFoot}) {
            EXPECT_LT(glm::distance(rest[foot].position, frames[foot].position), 1e-6);
        }
    }
}

}  // namespace
}  // namespace vellus::sculpt
