// Fur on real characters over whole animations, against the plain implementation of skinning.
#include <numbers>

#include "tests/unit/hair/binding/bound_character.h"

namespace vellus::hair {
namespace {

using test::BoundCharacter;

constexpr size_t kStrands = 2000;
constexpr int kSteps = 40;
constexpr double kTolerance = 1e-4;

struct Case {
    const char* file;
    const char* head;
};

class BoundFur : public testing::TestWithParam<Case> {
  protected:
    void SetUp() override {
        if (!BoundCharacter::exists(GetParam().file)) GTEST_SKIP() << "no " << GetParam().file;
        open({});
    }
    void open(const scene::LocalTransform& place) {
        character = std::make_unique<BoundCharacter>(GetParam().file, kStrands, place);
        head = character->size_of(GetParam().head);
        ASSERT_EQ(character->bound.roots.size(), character->strands.strand_count());
    }
    /// Largest distance of a root from where it was grown, over all strands, this frame.
    [[nodiscard]] double worst_root(PoseOf when = PoseOf::kNow) const {
        const auto& columns = character->world.resource<character::DeformColumns>();
        const auto surface =
            when == PoseOf::kNow
                ? character->skin(columns.palette, columns.weights)
                : character->skin(columns.previous_palette, columns.previous_weights);
        double worst = 0.0;
        for (size_t s = 0; s < character->strands.strand_count(); ++s) {
            const auto first = character->bound.roots[s].first_point;
            worst = std::max(worst, glm::distance(character->point(s, first, when),
                                                  character->root_on(surface, s)));
        }
        return worst;
    }

    std::unique_ptr<BoundCharacter> character;
    double head = 0.0;
};

TEST_P(BoundFur, RootsStayOnTheSkinOverWholeAnimations) {
    double worst = 0.0;
    for (uint32_t a = 0; a < character->asset->animations.size(); ++a) {
        for (int i = 0; i <= kSteps; ++i) {
            character->show(a, character->asset->animations[a].duration * i / kSteps);
            worst = std::max(worst, worst_root());
        }
    }
    RecordProperty("worst_over_head", std::to_string(worst / head));
    EXPECT_LT(worst, kTolerance * head) << "head " << head;
}

TEST_P(BoundFur, ShapeIsRigidWhateverThePose) {
    character->show(0, 0.37 * character->asset->animations[0].duration);
    for (size_t s = 0; s < character->strands.strand_count(); ++s) {
        const auto& root = character->bound.roots[s];
        for (uint32_t i = 1; i < root.point_count; ++i) {
            const uint32_t p = root.first_point + i;
            const double rest = glm::distance(character->strands.positions[p],
                                              character->strands.positions[root.first_point]);
            const double now =
                glm::distance(character->point(s, p), character->point(s, root.first_point));
            // Float positions of a body some thirty strands long.
            ASSERT_NEAR(now, rest, 1e-5 * character->fur_length);
        }
    }
}

TEST_P(BoundFur, AtRestTheGroomIsWhereItWasGrown) {
    for (size_t s = 0; s < character->strands.strand_count(); ++s) {
        const auto& root = character->bound.roots[s];
        for (uint32_t i = root.first_point; i < root.first_point + root.point_count; ++i) {
            ASSERT_LT(
                glm::distance(character->point(s, i), glm::dvec3(character->strands.positions[i])),
                1e-4 * character->fur_length);
        }
    }
}

TEST_P(BoundFur, LastFramesPointsAreThoseOfTheFrameBefore) {
    const double duration = character->asset->animations[0].duration;
    std::vector<glm::dvec3> before(character->bound.local.size());
    for (int frame = 0; frame < 6; ++frame) {
        auto* place = character->world.get<scene::LocalTransform>(character->root());
        place->translation += glm::dvec3(0.1, 0.02, -0.3);
        place->rotation = glm::angleAxis(0.2f * static_cast<float>(frame), glm::vec3(0, 1, 0));
        character->show(0, duration * frame / 17.0);
        for (size_t s = 0; s < character->strands.strand_count(); ++s) {
            const auto& root = character->bound.roots[s];
            const uint32_t tip = root.first_point + root.point_count - 1;
            if (frame > 0) {
                // Both in float, relative to the anchors of their frames.
                ASSERT_LT(glm::distance(character->point(s, tip, PoseOf::kBefore), before[tip]),
                          1e-4 * character->fur_length);
            }
            before[tip] = character->point(s, tip);
        }
    }
}

TEST_P(BoundFur, BoundsHoldEveryPoint) {
    for (uint32_t a = 0; a < character->asset->animations.size(); ++a) {
        for (int i = 0; i <= kSteps; ++i) {
            character->show(a, character->asset->animations[a].duration * i / kSteps);
            const scene::Box box = pose_bounds(character->bound, character->pose, 0.0);
            for (size_t s = 0; s < character->strands.strand_count(); ++s) {
                const auto& root = character->bound.roots[s];
                for (uint32_t k = 0; k < root.point_count; ++k) {
                    const glm::dvec3 p = character->point(s, root.first_point + k);
                    ASSERT_TRUE(glm::all(glm::lessThanEqual(box.min, p)) &&
                                glm::all(glm::lessThanEqual(p, box.max)))
                        << "animation " << a << " step " << i << " strand " << s;
                }
            }
            // And not much more: a strand on each side, and boxes of turned patches around it.
            scene::Box skin;
            for (const glm::dvec3& p : character->skin_now().positions) skin.include(p);
            const glm::dvec3 slack = (box.max - box.min) - (skin.max - skin.min);
            ASSERT_LT(std::max({slack.x, slack.y, slack.z}), 10.0 * character->fur_length);
        }
    }
}

TEST_P(BoundFur, ATeleportedTurnedAndScaledCharacterWearsTheSameFur) {
    character->show(0, 0.5 * character->asset->animations[0].duration);
    const double duration = 0.5 * character->asset->animations[0].duration;
    std::vector<glm::dvec3> here;
    for (size_t s = 0; s < character->strands.strand_count(); ++s) {
        const auto& root = character->bound.roots[s];
        here.push_back(character->point(s, root.first_point + root.point_count - 1));
    }
    auto& place = *character->world.get<scene::LocalTransform>(character->root());
    place.translation = {1e6, -2e5, 3e6};
    place.rotation = glm::angleAxis(static_cast<float>(std::numbers::pi), glm::vec3(0, 1, 0));
    place.scale = glm::vec3(0.25f);
    character->world.query<scene::PreviousWorldTransform>().each(
        [](scene::PreviousWorldTransform& previous) { previous.known = false; });
    character->show(0, duration);
    const glm::dmat4 moved = character->world.get<scene::WorldTransform>(character->root())->matrix;
    for (size_t s = 0; s < character->strands.strand_count(); ++s) {
        const auto& root = character->bound.roots[s];
        const uint32_t tip = root.first_point + root.point_count - 1;
        const glm::dvec3 expected(moved * glm::dvec4(here[s], 1.0));
        // Doubles near 3e6 m are 5e-10 m apart; the palettes' products lose a few digits more.
        ASSERT_LT(glm::distance(character->point(s, tip), expected),
                  1e-3 * 0.25 * character->fur_length + 1e-8);
        ASSERT_LT(
            glm::distance(character->point(s, tip, PoseOf::kBefore), character->point(s, tip)),
            1e-3 * 0.25 * character->fur_length + 1e-8)
            << "a teleport has no velocity";
    }
}

TEST_P(BoundFur, AMirroredCharacterWearsItsFurOutside) {
    character->show(0, 0.3 * character->asset->animations[0].duration);
    std::vector<glm::dvec3> here;
    for (size_t i = 0; i < character->bound.local.size(); ++i) here.emplace_back(0.0);
    const auto each_tip = [&](const auto& visit) {
        for (size_t s = 0; s < character->strands.strand_count(); ++s) {
            const auto& root = character->bound.roots[s];
            visit(s, root.first_point + root.point_count - 1);
        }
    };
    each_tip([&](size_t s, uint32_t tip) { here[tip] = character->point(s, tip); });
    character->world.get<scene::LocalTransform>(character->root())->scale = {-1, 1, 1};
    character->show(0, 0.3 * character->asset->animations[0].duration);
    each_tip([&](size_t s, uint32_t tip) {
        const glm::dvec3 expected = here[tip] * glm::dvec3(-1, 1, 1);
        ASSERT_LT(glm::distance(character->point(s, tip), expected), 1e-3 * character->fur_length);
    });
}

INSTANTIATE_TEST_SUITE_P(
    Files, BoundFur,
    testing::Values(Case{"Fox.glb", "b_Head_05"},
                    Case{"CesiumMan.collada2gltf.glb", "Skeleton_neck_joint_2"},
                    Case{"MorphStressTest.gltf", ""}, Case{"SimpleSkin.gltf", ""}),
    [](const auto& file) {
        const std::string name = file.param.file;
        return name.substr(0, name.find('.'));
    });

}  // namespace
}  // namespace vellus::hair
