#include "modules/hair/binding/bind_roots.h"

#include <gtest/gtest.h>

#include "modules/hair/binding/hair_pose.h"
#include "tests/unit/hair/binding/bent_tube.h"

namespace vellus::hair {
namespace {

using test::BentTube;

/// A pose of the tube for make_pose: joints, then last frame's, in the world.
HairPose pose_of(const BoundRoots& bound, const std::vector<glm::dmat4>& palette,
                 const std::vector<float>& weights, const glm::dmat4& world = glm::dmat4(1.0)) {
    character::DeformColumns columns;
    columns.palette = columns.previous_palette = palette;
    columns.weights = columns.previous_weights = weights;
    const character::MeshSlot slot{0, static_cast<uint32_t>(palette.size()), 0,
                                   static_cast<uint32_t>(weights.size())};
    HairPose pose;
    make_pose(bound, columns, slot, world, world, pose);
    return pose;
}

glm::dvec3 tip_of(const BoundRoots& bound, const HairPose& pose, uint32_t strand) {
    const RootFrame frame = root_frame(bound, pose, strand, PoseOf::kNow);
    const BoundRoot& root = bound.roots[strand];
    return frame.position +
           frame.axes * glm::dvec3(bound.local[root.first_point + root.point_count - 1]);
}

const std::vector<glm::dmat4> kRest = {glm::dmat4(1.0), glm::dmat4(1.0)};

Result<BoundRoots> bind(const StrandData& strands, const asset::Mesh& mesh,
                        const glm::dmat4& placement = glm::dmat4(1.0)) {
    auto rest = rest_mesh(mesh, kRest, {});
    if (!rest) return rest.error();
    return bind_roots({strands.positions, strands.strand_begin}, placement, *rest);
}

TEST(BindRoots, AnEmptyGroomIsBoundToNothing) {
    const BentTube tube(12, 20);
    const auto bound = bind(StrandData{}, tube.mesh());
    ASSERT_TRUE(bound);
    EXPECT_TRUE(bound->roots.empty());
    EXPECT_TRUE(bound->vertices.empty());
    const HairPose pose = pose_of(*bound, kRest, {});
    EXPECT_TRUE(pose_bounds(*bound, pose, 0.1).empty());
}

TEST(BindRoots, KeepsOnlyVerticesUnderRoots) {
    const BentTube tube(12, 20);
    const StrandData strands = tube.fur(3);
    const auto bound = bind(strands, tube.mesh());
    ASSERT_TRUE(bound);
    EXPECT_EQ(bound->roots.size(), 3u);
    EXPECT_LE(bound->vertices.size(), 9u);
    EXPECT_LT(bound->farthest, 1e-6);
}

TEST(BindRoots, RootsOffTheSkinKeepTheirDistance) {
    const BentTube tube(48, 20);
    StrandData strands = tube.fur(200);
    // Off the skin along the surface's normals, which here point away from the axis.
    for (glm::vec3& p : strands.positions) p += 0.02f * tube.outward(p);
    const auto bound = bind(strands, tube.mesh());
    ASSERT_TRUE(bound);
    EXPECT_NEAR(bound->farthest, 0.02, 0.002);
    const HairPose pose = pose_of(*bound, kRest, {});
    for (uint32_t s = 0; s < bound->roots.size(); ++s) {
        const uint32_t last = strands.strand_begin[s + 1] - 1;
        ASSERT_LT(glm::distance(tip_of(*bound, pose, s), glm::dvec3(strands.positions[last])),
                  1e-6);
    }
}

TEST(BindRoots, DegenerateMeshes) {
    const BentTube tube(12, 20);
    const StrandData strands = tube.fur(50);
    asset::Mesh flat = tube.mesh();
    for (glm::vec3& p : flat.primitives[0].positions) p.x = p.y = 0.0f;
    const auto bound = bind(strands, flat);
    ASSERT_FALSE(bound);
    EXPECT_NE(bound.error().message().find("no triangle has an area"), std::string::npos);
    asset::Mesh lines = tube.mesh();
    lines.primitives[0].topology = asset::Topology::kLines;
    EXPECT_NE(bind(strands, lines).error().message().find("has no triangles"), std::string::npos);
    asset::Mesh joints = tube.mesh();
    joints.primitives[0].joints[3].x = 9;
    EXPECT_NE(bind(strands, joints).error().message().find("joint 9"), std::string::npos);
}

TEST(BindRoots, TrianglesThatCollapseLaterLeaveStrandsWhole) {
    const BentTube tube(12, 20);
    const StrandData strands = tube.fur(300);
    const auto bound = bind(strands, tube.mesh());
    ASSERT_TRUE(bound);
    const glm::dmat4 line = glm::scale(glm::dmat4(1.0), {0.0, 0.0, 1.0});
    const glm::dmat4 point(glm::scale(glm::dmat4(1.0), glm::dvec3(0.0)));
    for (const glm::dmat4& collapsed : {line, point}) {
        const HairPose pose = pose_of(*bound, {glm::dmat4(1.0), collapsed}, {});
        for (uint32_t s = 0; s < bound->roots.size(); ++s) {
            const RootFrame frame = root_frame(*bound, pose, s, PoseOf::kNow);
            const glm::dmat3 should = glm::transpose(frame.axes) * frame.axes;
            for (int i = 0; i < 3; ++i) {
                for (int k = 0; k < 3; ++k) ASSERT_NEAR(should[i][k], i == k ? 1 : 0, 1e-5);
            }
        }
    }
}

TEST(BindRoots, AMorphedSurfaceTurnsItsStrands) {
    // A target that turns the whole tube by a small angle about Z: as a displacement it is exact
    // only at weight 0 and, up to stretching, at 1.
    const BentTube tube(24, 20);
    const StrandData strands = tube.fur(200);
    asset::Mesh mesh = tube.mesh();
    const double angle = 0.4;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), angle, {0, 0, 1});
    asset::MorphTarget target;
    for (const glm::vec3& p : mesh.primitives[0].positions) {
        target.positions.emplace_back(glm::dvec3(turn * glm::dvec4(p, 1.0)) - glm::dvec3(p));
    }
    mesh.primitives[0].morph_targets = {target};
    const auto bound = bind(strands, mesh);
    ASSERT_TRUE(bound);
    ASSERT_EQ(bound->target_count, 1u);
    const HairPose pose = pose_of(*bound, kRest, {1.0f});
    for (uint32_t s = 0; s < bound->roots.size(); ++s) {
        const uint32_t last = strands.strand_begin[s + 1] - 1;
        const glm::dvec3 expected(turn * glm::dvec4(strands.positions[last], 1.0));
        ASSERT_LT(glm::distance(tip_of(*bound, pose, s), expected), 1e-6);
    }
}

TEST(BindRoots, PlacementsScaleTurnAndMirror) {
    const BentTube tube(24, 20);
    const StrandData strands = tube.fur(200);
    const glm::dmat4 place = glm::rotate(glm::dmat4(1.0), 0.8, {0.6, 0, 0.8}) *
                             glm::scale(glm::dmat4(1.0), {-2.0, 2.0, 2.0});
    // The groom as if authored in another space: placed, it is where it was.
    StrandData placed = strands;
    for (glm::vec3& p : placed.positions) {
        p = glm::vec3(glm::inverse(place) * glm::dvec4(p, 1.0));
    }
    const auto bound = bind(placed, tube.mesh(), place);
    ASSERT_TRUE(bound);
    EXPECT_NEAR(bound->rest_scale, -2.0, 1e-12);
    const HairPose pose = pose_of(*bound, kRest, {}, place);
    for (uint32_t s = 0; s < bound->roots.size(); ++s) {
        const uint32_t last = strands.strand_begin[s + 1] - 1;
        ASSERT_LT(glm::distance(tip_of(*bound, pose, s), glm::dvec3(strands.positions[last])),
                  2e-6);
    }
}

TEST(BindRoots, AnotherOrderOfVerticesAndTrianglesIsTheSameSkin) {
    const BentTube tube(24, 20);
    const StrandData strands = tube.fur(500);
    const auto a = bind(strands, tube.mesh());
    const auto b = bind(strands, tube.shuffled());
    ASSERT_TRUE(a);
    ASSERT_TRUE(b);
    const std::vector<glm::dmat4> bent = {glm::dmat4(1.0),
                                          glm::rotate(glm::dmat4(1.0), 0.9, {1, 0, 0})};
    const HairPose pose_a = pose_of(*a, bent, {});
    const HairPose pose_b = pose_of(*b, bent, {});
    for (uint32_t s = 0; s < a->roots.size(); ++s) {
        ASSERT_LT(glm::distance(tip_of(*a, pose_a, s), tip_of(*b, pose_b, s)), 2e-6);
    }
}

TEST(BindRoots, AFinerMeshOfTheSameShapeCarriesTheSameWay) {
    const BentTube coarse(24, 20);
    const StrandData strands = coarse.fur(500);
    const auto a = bind(strands, coarse.mesh());
    const auto b = bind(strands, coarse.subdivided());
    ASSERT_TRUE(a);
    ASSERT_TRUE(b);
    EXPECT_LT(b->farthest, 1e-6) << "midpoints lie on the coarse faces";
    const std::vector<glm::dmat4> moved(2, glm::rotate(glm::dmat4(1.0), 2.1, {0.48, 0.6, 0.64}));
    const std::vector<glm::dmat4> bent = {glm::dmat4(1.0),
                                          glm::rotate(glm::dmat4(1.0), 0.5, {1, 0, 0})};
    for (uint32_t s = 0; s < a->roots.size(); ++s) {
        ASSERT_LT(glm::distance(tip_of(*a, pose_of(*a, moved, {}), s),
                                tip_of(*b, pose_of(*b, moved, {}), s)),
                  2e-6);
        // Bent, midpoints no longer lie in the middle: by a part of a triangle's sagitta.
        ASSERT_LT(glm::distance(tip_of(*a, pose_of(*a, bent, {}), s),
                                tip_of(*b, pose_of(*b, bent, {}), s)),
                  0.02);
    }
}

}  // namespace
}  // namespace vellus::hair
