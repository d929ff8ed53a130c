#include <algorithm>
#include <cmath>

#include "modules/hair/binding/deform_passes.h"
#include "modules/hair/cards/add_cards.h"
#include "modules/hair/cards/build_cards.h"
#include "modules/hair/cards/card_columns.h"
#include "modules/hair/dynamics/card_rows.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "tests/support/hair_scene.h"
#include "tests/unit/hair/cards/card_strands.h"

// Cards in motion, carried by their node.
namespace vellus::hair {
namespace {

using CardMotion = vellus::test::GpuTest;

/// Locks side by side before the camera, as ribbons.
CardGroom ribbons() {
    Groom groom;
    for (int i = 0; i < 6; ++i) {
        test::add_lock(groom,
                       {.root = {-0.1f + 0.04f * static_cast<float>(i), 0.12f, -1.0f},
                        .length = 0.22f,
                        .bend = 0.03f},
                       40, static_cast<uint32_t>(i));
    }
    auto built =
        build_cards(test::strands_of(groom, 0.0004f), {.cards = 6, .max_texels = 1U << 16U});
    EXPECT_TRUE(built);
    return built->cards;
}

/// Sheets of 3 by 9 points as an artist makes them, their rows not quite level in the atlas.
CardGroom sheets() {
    CardGroom cards;
    for (int card = 0; card < 5; ++card) {
        const auto first = static_cast<uint32_t>(cards.points.size());
        for (int row = 0; row < 9; ++row) {
            for (int column = 0; column < 3; ++column) {
                const float u = 0.5f * static_cast<float>(column);
                const float v = static_cast<float>(row) / 8.0f;
                cards.points.emplace_back(-0.1f + 0.05f * static_cast<float>(card) + 0.03f * u,
                                          0.12f - 0.22f * v, -1.0f + 0.03f * v * v);
                cards.uvs.emplace_back(u, std::min(v + 0.004f * u, 1.0f));
            }
        }
        for (uint32_t row = 0; row < 8; ++row) {
            for (uint32_t column = 0; column < 2; ++column) {
                const uint32_t a = first + 3 * row + column;
                cards.triangles.emplace_back(a, a + 3, a + 1);
                cards.triangles.emplace_back(a + 1, a + 3, a + 4);
            }
        }
    }
    cards.depth_range = 0.01f;
    cards.atlas.width = cards.atlas.height = 16;
    cards.atlas.opacity.assign(256, 255);
    cards.atlas.depth.assign(256, 128);
    cards.atlas.tangent.assign(256, glm::u8vec3(128, 255, 128));
    derive_columns(cards);
    return cards;
}

struct Scene {
    Scene(gpu::Device& device, const CardGroom& cards) : scene(device, 96, 96) {
        scene.add_sun({0, 0, 1});
        const auto groom = add_cards(scene.world, device, "cards", cards);
        EXPECT_TRUE(groom);
        hair = spawn_hair(scene.world, *groom, {}, {}, kNoEntity);
        EXPECT_TRUE(add_motion(scene.world, device, hair, {}, 3));
        scene.build();
    }
    const LibraryGroom& groom() { return scene.world.resource<HairLibrary>().grooms[0]; }
    const GroomMotion& motion() { return *scene.world.resource<HairMotions>().list[0]; }
    /// Shakes the cards; their points then, metres from where the node is.
    std::vector<glm::vec3> shaken(gpu::Device& device, int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            scene.world.get<scene::LocalTransform>(hair)->translation = {
                0.05 * std::sin(0.3 * frame), 0.0, 0.0};
            scene.draw();
        }
        std::vector<glm::vec3> points(groom().positions.size());
        EXPECT_TRUE(scene.world.resource<HairDeformation>().points.read_back(
            device, std::as_writable_bytes(std::span(points))));
        return points;
    }

    vellus::test::HairScene scene;
    Entity hair;
};

TEST_F(CardMotion, RowsTurnAsOneAndKeepTheirDistance) {
    for (const CardGroom& cards : {ribbons(), sheets()}) {
        Scene scene(device(), cards);
        const std::vector<glm::vec3> points = scene.shaken(device(), 25);
        const auto& rest = scene.groom().positions;
        const CardRows rows = cut_rows(scene.groom());
        EXPECT_EQ(rows.points.size(), rest.size());
        float swung = 0.0f;
        for (uint32_t card = 0; card + 1 < rows.card_begin.size(); ++card) {
            const auto was = rows.line(rest, card);
            const auto now = rows.line(points, card);
            ASSERT_EQ(was.size(), now.size());
            ASSERT_GE(was.size(), 5U);
            EXPECT_LT(glm::distance(now[0], was[0]), 1e-5f) << "roots stay";
            for (size_t row = 1; row < was.size(); ++row) {
                const float length = glm::distance(was[row], was[row - 1]);
                EXPECT_NEAR(glm::distance(now[row], now[row - 1]), length, 1e-3f * length);
                swung = std::max(swung, glm::distance(now[row], was[row]));
            }
        }
        for (size_t row = 0; row + 1 < rows.row_begin.size(); ++row) {
            for (uint32_t i = rows.row_begin[row] + 1; i < rows.row_begin[row + 1]; ++i) {
                const uint32_t a = rows.points[i - 1];
                const uint32_t b = rows.points[i];
                EXPECT_NEAR(glm::distance(points[a], points[b]), glm::distance(rest[a], rest[b]),
                            1e-5f);
            }
        }
        EXPECT_GT(swung, 0.02f);
    }
}

TEST_F(CardMotion, CardsThatAreGuidesGoWhereTheyWereSolved) {
    for (const CardGroom& cards : {ribbons(), sheets()}) {
        Scene scene(device(), cards);
        const std::vector<glm::vec3> points = scene.shaken(device(), 25);
        const CardRows rows = cut_rows(scene.groom());
        const GroomMotion& motion = scene.motion();
        ASSERT_EQ(motion.strands.size(), 3U);
        for (uint32_t g = 0; g < 3; ++g) {
            const auto solved = guide_points(motion.motion.guides(), motion.motion.state(), g);
            const glm::vec3 root = motion.motion.guides().root[g];
            const auto drawn = rows.line(points, motion.strands[g]);
            // Fifteen links and eight rows or more of 22 cm cut the curve at different places.
            EXPECT_LT(glm::distance(drawn.back(), root + solved.back()), 0.006f);
        }
    }
}

TEST(CardRows, AMeshIsCutWhereItsPointsLieLevel) {
    LibraryGroom groom;
    // Two rows of three, points out of order, and a tip.
    groom.positions = {{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {1, 0, 0},
                       {2, 1, 0}, {2, 0, 0}, {1, -1, 0}};
    groom.card_parameters = {0, 32000, 100, 32700, 50, 32300, 65535};
    groom.strand_begin = {0, 7};
    const CardRows rows = cut_rows(groom);
    EXPECT_EQ(rows.row_begin, (std::vector<uint32_t>{0, 3, 6, 7}));
    EXPECT_EQ(rows.points, (std::vector<uint32_t>{0, 4, 2, 1, 5, 3, 6}));
    const auto line = rows.line(groom.positions, 0);
    ASSERT_EQ(line.size(), 3U);
    EXPECT_EQ(line[1], glm::vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(rows.half_width, 1.0f);
}

}  // namespace
}  // namespace vellus::hair
