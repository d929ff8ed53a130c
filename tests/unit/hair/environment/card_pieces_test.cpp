#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "modules/hair/cards/build_cards.h"
#include "modules/hair/cards/card_columns.h"
#include "modules/hair/environment/ambient_depth.h"
#include "modules/hair/groom/strand_data.h"
#include "tests/unit/hair/cards/card_strands.h"

namespace vellus::hair {
namespace {

/// Area seen along x, y and z.
glm::dvec3 total(const AmbientPieces& pieces) {
    glm::dvec3 sum(0.0);
    for (const StrandArea& strands : pieces.strands) {
        sum +=
            glm::dvec3(strands.seen({1, 0, 0}), strands.seen({0, 1, 0}), strands.seen({0, 0, 1}));
    }
    return sum;
}

TEST(CardPieces, OfAHalfCoveredCardAddUpToItsStrands) {
    CardGroom cards;
    cards.points = {{0, 0.2f, 0}, {0.05f, 0.2f, 0}, {0, 0, 0}, {0.05f, 0, 0}};
    cards.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    cards.triangles = {{0, 2, 1}, {1, 2, 3}};
    cards.atlas.width = cards.atlas.height = 16;
    cards.atlas.opacity.assign(256, 0);
    // Every other column is opaque.
    for (size_t i = 0; i < 256; i += 2) cards.atlas.opacity[i] = 255;
    cards.atlas.depth.assign(256, 128);
    cards.atlas.tangent.assign(256, glm::u8vec3(128, 255, 128));
    derive_columns(cards);
    const glm::dvec3 area = total(card_pieces(cards));
    const double by_hand = 0.05 * 0.2 * std::log(2.0);
    // Samples of columns that are on or off.
    EXPECT_NEAR(area.x, by_hand, 0.03 * by_hand);
    EXPECT_NEAR(area.z, by_hand, 0.03 * by_hand);
    // A byte of the tangent is off by up to 1/254, seen at its root.
    EXPECT_NEAR(area.y, 0.0, 0.07 * by_hand) << "strands along y show nothing of themselves there";
}

TEST(CardPieces, OfBuiltCardsHaveTheAreaOfTheirStrands) {
    Groom groom;
    for (int lock = 0; lock < 12; ++lock) {
        const auto angle = glm::two_pi<float>() * static_cast<float>(lock) / 12.0f;
        test::add_lock(groom, {.root = {0.1f * std::cos(angle), 0.1f, 0.1f * std::sin(angle)}}, 100,
                       static_cast<uint32_t>(lock));
    }
    const StrandData strands = test::strands_of(groom, 0.0001f);
    const auto built = build_cards(strands, {.cards = 12, .tip_scale = 1.0f});
    ASSERT_TRUE(built) << built.error().message();
    const double length =
        std::accumulate(strands.strand_length.begin(), strands.strand_length.end(), 0.0);
    const glm::dvec3 area = total(card_pieces(built->cards));
    // Straight down: whole widths along x and z. Texels of a row are as wide as the card is there,
    // strands as wide as where the bake met them: some percent.
    EXPECT_NEAR(area.x / (length * 1e-4), 1.0, 0.06);
    EXPECT_NEAR(area.z / (length * 1e-4), 1.0, 0.06);
}

}  // namespace
}  // namespace vellus::hair
