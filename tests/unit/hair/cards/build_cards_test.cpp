#include "modules/hair/cards/build_cards.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <set>

#include "modules/hair/cards/atlas_levels.h"
#include "modules/hair/cards/bake.h"
#include "modules/hair/cards/cluster.h"
#include "modules/hair/cards/face_outwards.h"
#include "modules/hair/cards/pack.h"
#include "modules/hair/cards/row_directions.h"
#include "modules/hair/cards/strand_path.h"
#include "tests/support/sampling.h"
#include "tests/unit/hair/cards/card_strands.h"

// Cards against what is known of the strands they stand for: area, place, direction.
namespace vellus::hair {
namespace {

using test::add_lock;
using test::strands_of;

constexpr float kWidth = 0.0004f;

std::vector<uint32_t> all_of(const StrandData& strands) {
    std::vector<uint32_t> members(strands.strand_count());
    std::iota(members.begin(), members.end(), 0U);
    return members;
}

void add_strand(Groom& groom, const std::vector<glm::vec3>& points) {
    groom.points.insert(groom.points.end(), points.begin(), points.end());
    groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
}

Groom head_of_locks(int locks, int strands_each) {
    Groom groom;
    for (int i = 0; i < locks; ++i) {
        const float a = 6.2831853f * static_cast<float>(i) / static_cast<float>(locks);
        add_lock(groom,
                 {.root = {0.1f * std::cos(a), 0.0f, 0.1f * std::sin(a)},
                  .radius = 0.008f,
                  .fan = 1.5f,
                  .bend = 0.03f},
                 strands_each, static_cast<uint32_t>(i + 1));
    }
    return groom;
}

TEST(CardClusterTest, LocksApartAreTheirOwnClusters) {
    const StrandData strands = strands_of(head_of_locks(6, 20), kWidth);
    const std::vector<uint32_t> labels = cluster_strands(strands, 6);
    // Strands of one lock share a label, and no two locks do: strand_source tells the lock.
    std::vector<std::set<uint32_t>> labels_of_lock(6);
    for (size_t s = 0; s < labels.size(); ++s) {
        labels_of_lock[strands.strand_source[s] / 20].insert(labels[s]);
    }
    std::set<uint32_t> seen;
    for (const auto& lock : labels_of_lock) {
        EXPECT_EQ(lock.size(), 1u);
        seen.insert(lock.begin(), lock.end());
    }
    EXPECT_EQ(seen.size(), 6u);
}

TEST(CardClusterTest, NoClusterIsEmptyEvenWhenAskedForMoreThanThereAreStrands) {
    const StrandData strands = strands_of(head_of_locks(2, 5), kWidth);
    for (const uint32_t count : {1u, 3u, 10u, 500u}) {
        const std::vector<uint32_t> labels = cluster_strands(strands, count);
        const uint32_t highest = *std::ranges::max_element(labels);
        EXPECT_LT(highest, std::min<size_t>(count, strands.strand_count()));
        const std::set<uint32_t> used(labels.begin(), labels.end());
        EXPECT_EQ(used.size(), highest + 1) << count;
    }
}

TEST(CardClusterTest, StrandsThatWeaveTogetherStayTogether) {
    // Three bundles about one axis that change places once in each eighth of their length, so that
    // the means of eight pieces are all the same.
    constexpr uint32_t kBundles = 3;
    Groom groom;
    for (uint32_t strand = 0; strand < 90; ++strand) {
        vellus::test::Random random(3, strand);
        const double turned = 2.0 * std::numbers::pi * (strand % kBundles) / kBundles;
        const glm::dvec3 root(random.range(-0.002, 0.002), 0.0, random.range(-0.002, 0.002));
        std::vector<glm::vec3> points;
        for (int i = 0; i <= 256; ++i) {
            const double t = i / 256.0;
            const double phase = 16.0 * std::numbers::pi * t + turned;
            points.emplace_back(
                root + glm::dvec3(0.01 * std::sin(phase), -0.4 * t, 0.005 * std::sin(2.0 * phase)));
        }
        add_strand(groom, points);
    }
    const StrandData strands = strands_of(groom, kWidth);
    const std::vector<uint32_t> labels = cluster_strands(strands, kBundles);
    std::vector<std::set<uint32_t>> labels_of_bundle(kBundles);
    for (size_t strand = 0; strand < labels.size(); ++strand) {
        labels_of_bundle[strands.strand_source[strand] % kBundles].insert(labels[strand]);
    }
    for (const auto& bundle : labels_of_bundle) EXPECT_EQ(bundle.size(), 1U);
}

/// Where a strand is on the drawn surface of the ribbon, by projecting it on the plane of the
/// closest quad: the share of points that lie inside the quad's outline.
TEST(CardRibbonTest, HoldsEveryStrandWithItsWidth) {
    for (const float curl : {0.0f, 0.004f}) {
        Groom groom;
        add_lock(groom, {.radius = 0.01f, .fan = 2.5f, .bend = 0.08f, .curl = curl}, 60, 7);
        const StrandData strands = strands_of(groom, kWidth);
        const Ribbon ribbon = fit_ribbon(strands, all_of(strands), {.tip_scale = 1.0f});
        for (size_t s = 0; s < strands.strand_count(); ++s) {
            for (int i = 0; i <= 200; ++i) {
                const float fraction = static_cast<float>(i) / 200.0f;
                const RibbonPoint at =
                    ribbon.locate(strand_position(strands, s, fraction), fraction, 0);
                // Points between the 96 samples that were measured may bulge out by a little of a
                // curl's radius.
                const float slack = 1e-5f + 0.1f * curl;
                EXPECT_LE(std::abs(at.across) + 0.5f * kWidth, ribbon.half_width(at) + slack);
                EXPECT_LE(std::abs(at.toward) + 0.5f * kWidth, ribbon.half_thickness(at) + slack);
            }
        }
    }
}

TEST(CardRibbonTest, LiesWhereTheStrandsSpreadMost) {
    Groom groom;
    add_lock(groom, {.radius = 0.01f, .flatness = 0.1f}, 80, 3);
    const StrandData strands = strands_of(groom, kWidth);
    const Ribbon ribbon = fit_ribbon(strands, all_of(strands), {});
    for (const RibbonRow& row : ribbon.rows) {
        EXPECT_GT(std::abs(row.across.x), 0.99f);
        EXPECT_NEAR(glm::length(row.across), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(row.across, row.along), 0.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(glm::cross(row.across, row.along), row.toward), 1.0f, 1e-5f);
        EXPECT_LT(row.half_thickness, 0.5f * row.half_width);
    }
    EXPECT_NEAR(ribbon.length(), 0.22f, 0.005f);
}

TEST(CardRibbonTest, RowsFollowTheBend) {
    Groom straight;
    Groom bent;
    add_lock(straight, {}, 20, 1);
    add_lock(bent, {.bend = 0.2f}, 20, 1);
    const StrandData a = strands_of(straight, kWidth);
    const StrandData b = strands_of(bent, kWidth);
    const size_t few = fit_ribbon(a, all_of(a), {.max_rows = 64}).rows.size();
    const size_t many =
        fit_ribbon(b, all_of(b), {.max_rows = 64, .tolerance = 0.0001f}).rows.size();
    EXPECT_GT(many, few);
    for (const uint32_t limit : {2u, 3u, 5u, 9u, 20u}) {
        EXPECT_LE(fit_ribbon(b, all_of(b), {.max_rows = limit}).rows.size(), limit);
    }
}

/// Area of the union of flat strands in the XY plane by brute force: points of a fine grid within
/// half a width of any of them, times the area of a grid cell. In square metres.
double brute_force_area(const StrandData& strands, float tip_scale) {
    constexpr double kCell = 0.0001;
    const glm::vec3 low = strands.bounds.low - kWidth;
    const glm::vec3 high = strands.bounds.high + kWidth;
    const auto columns = static_cast<size_t>((high.x - low.x) / kCell) + 1;
    const auto rows = static_cast<size_t>((high.y - low.y) / kCell) + 1;
    std::vector<uint8_t> covered(columns * rows, 0);
    for (size_t segment = 0; segment < strands.segment_count(); ++segment) {
        const uint32_t point = strands.segment_point[segment];
        const glm::dvec2 a(strands.positions[point]);
        const glm::dvec2 b(strands.positions[point + 1]);
        const glm::dvec2 step = b - a;
        const double radius[2] = {0.5 * strand_width(strands, point, tip_scale),
                                  0.5 * strand_width(strands, point + 1, tip_scale)};
        const auto cell = [&](double value, double start) {
            return static_cast<size_t>(std::max((value - start) / kCell, 0.0));
        };
        for (size_t y = cell(std::min(a.y, b.y) - kWidth, low.y);
             y <= std::min(cell(std::max(a.y, b.y) + kWidth, low.y), rows - 1); ++y) {
            for (size_t x = cell(std::min(a.x, b.x) - kWidth, low.x);
                 x <= std::min(cell(std::max(a.x, b.x) + kWidth, low.x), columns - 1); ++x) {
                const glm::dvec2 p(low.x + (static_cast<double>(x) + 0.5) * kCell,
                                   low.y + (static_cast<double>(y) + 0.5) * kCell);
                const double t = std::clamp(glm::dot(p - a, step) / glm::dot(step, step), 0.0, 1.0);
                const double r = glm::mix(radius[0], radius[1], t);
                if (glm::distance(p, a + step * t) <= r) covered[y * columns + x] = 1;
            }
        }
    }
    return kCell * kCell * static_cast<double>(std::ranges::count(covered, 1));
}

/// A column of the atlas, where `one` stands for 1, over the area of the cards, quad by quad.
double card_area(const CardGroom& cards, const std::vector<uint8_t>& column, double one) {
    double area = 0.0;
    const CardAtlas& atlas = cards.atlas;
    for (size_t first = 0; first + 5 < cards.points.size(); first += 3) {
        const glm::vec3* p = &cards.points[first];
        if (std::ranges::find(cards.card_begin, first + 3) != cards.card_begin.end()) continue;
        const glm::vec2 low = cards.uvs[first];
        const glm::vec2 high = cards.uvs[first + 4];
        const double length = glm::distance(0.5f * (p[0] + p[1]), 0.5f * (p[3] + p[4]));
        const double height = (high.y - low.y) * static_cast<float>(atlas.height);
        const auto y0 =
            static_cast<uint32_t>(std::lround(low.y * static_cast<float>(atlas.height)));
        const auto y1 =
            static_cast<uint32_t>(std::lround(high.y * static_cast<float>(atlas.height)));
        const auto x0 = static_cast<uint32_t>(std::lround(low.x * static_cast<float>(atlas.width)));
        const auto x1 =
            static_cast<uint32_t>(std::lround(high.x * static_cast<float>(atlas.width)));
        for (uint32_t y = y0; y < y1; ++y) {
            const double t = (static_cast<double>(y - y0) + 0.5) / static_cast<double>(y1 - y0);
            const double width = glm::mix(static_cast<double>(glm::distance(p[0], p[1])),
                                          static_cast<double>(glm::distance(p[3], p[4])), t);
            double row = 0.0;
            for (uint32_t x = x0; x < x1; ++x) row += column[size_t{y} * atlas.width + x];
            area += row / one * width / (x1 - x0) * length / height;
        }
    }
    return area;
}

double card_area(const CardGroom& cards) {
    return card_area(cards, cards.atlas.opacity, 255.0);
}

constexpr float kCoilRadius = 0.004f;
constexpr float kCoilTurn = 40.0f;
constexpr float kCoilLength = 0.1f;

/// A lock whose strands wind together, as coily hair does.
Groom coil_lock() {
    Groom groom;
    add_lock(groom,
             {.length = kCoilLength,
              .radius = 0.002f,
              .flatness = 1.0f,
              .curl = kCoilRadius,
              .turn = kCoilTurn,
              .phases = 0.3f,
              .points = 160},
             40, 5);
    return groom;
}

TEST(CardRibbonTest, RunsAlongTheAxisOfStrandsThatWindTogether) {
    const StrandData strands = strands_of(coil_lock(), kWidth);
    const Ribbon ribbon = fit_ribbon(strands, all_of(strands), {});
    // Along their mean it would be nearly twice as long, and turn with them.
    EXPECT_NEAR(ribbon.length(), kCoilLength, 0.15f * kCoilLength);
    for (const RibbonRow& row : ribbon.rows) {
        // Their mean climbs by 0.53 of its length; at the ends the axis lies half a turn aside.
        EXPECT_LT(row.along.y, -0.8f) << row.distance;
        // Strands lie up to a coil's radius and the lock's own from the axis.
        EXPECT_LT(row.half_width, 2.0f * (kCoilRadius + 0.002f)) << row.distance;
    }
}

TEST(CardBakeTest, CoilsKeepTheirArea) {
    const StrandData strands = strands_of(coil_lock(), kWidth);
    auto built = build_cards(strands, {.cards = 1, .along_ratio = 1.0f, .tip_scale = 1.0f});
    ASSERT_TRUE(built);
    // Coils look alike from all sides but for where the turns of 40 strands happen to overlap.
    const double expected = brute_force_area(strands, 1.0f);
    EXPECT_NEAR(card_area(built->cards), expected, 0.1 * expected);
}

TEST(CardRibbonTest, StaysWithAStrandThatTurnsBackLater) {
    // A ribbon that folds over at a height of 5 cm and a strand that does so at 8 cm: from the
    // cross-sections before the fold a search that follows it down ends at the root.
    const auto row = [](glm::vec3 center, glm::vec3 along, float distance) {
        const glm::vec3 toward(0, 0, 1);
        return RibbonRow{center, glm::cross(along, toward), along, toward, 0.01f, 0.01f, distance};
    };
    Ribbon ribbon;
    for (int i = 0; i <= 5; ++i) {
        const float y = 0.01f * static_cast<float>(i);
        ribbon.rows.push_back(row({0, y, 0}, {0, 1, 0}, y));
    }
    ribbon.rows.push_back(row({0.01f, 0.06f, 0}, {1, 0, 0}, 0.064f));
    for (int i = 0; i <= 20; ++i) {
        const float down = 0.01f * static_cast<float>(i);
        ribbon.rows.push_back(row({0.02f, 0.05f - down, 0}, {0, -1, 0}, 0.078f + down));
    }
    const float length = 0.08f + 0.23f;
    uint32_t hint = 0;
    for (int i = 0; i <= 310; ++i) {
        const float walked = 0.001f * static_cast<float>(i);
        const bool up = walked <= 0.08f;
        const glm::vec3 p =
            up ? glm::vec3(0, walked, 0.004f) : glm::vec3(0.008f, 0.16f - walked, 0.004f);
        const RibbonPoint at = ribbon.locate(p, walked / length, hint);
        hint = at.interval;
        if (walked > 0.19f) {
            EXPECT_GT(at.interval, 6u) << walked;
            EXPECT_NEAR(std::abs(at.across), 0.012f, 1e-5f) << walked;
            EXPECT_NEAR(at.toward, 0.004f, 1e-5f) << walked;
        }
    }
}

TEST(CardRibbonTest, FacesAwayFromTheOtherHair) {
    // Meridians of a ball from near its pole to its equator, every other one with its front
    // inwards.
    constexpr int kRibbons = 24;
    std::vector<Ribbon> ribbons(kRibbons);
    for (int k = 0; k < kRibbons; ++k) {
        const float around = 6.2831853f * static_cast<float>(k) / kRibbons;
        for (int i = 0; i < 9; ++i) {
            const float down = 0.3f + 0.15f * static_cast<float>(i);
            const glm::vec3 out(std::sin(down) * std::cos(around), std::cos(down),
                                std::sin(down) * std::sin(around));
            const glm::vec3 front = k % 2 == 0 ? out : -out;
            const glm::vec3 along(std::cos(down) * std::cos(around), -std::sin(down),
                                  std::cos(down) * std::sin(around));
            ribbons[static_cast<size_t>(k)].rows.push_back(
                {.center = 0.1f * out,
                 .across = glm::cross(along, front),
                 .along = along,
                 .toward = front,
                 .half_width = 0.012f * std::sin(down),
                 .half_thickness = 0.002f,
                 .distance = 0.015f * static_cast<float>(i)});
        }
    }
    face_outwards(ribbons);
    for (const Ribbon& r : ribbons) {
        for (const RibbonRow& row : r.rows) {
            EXPECT_NEAR(glm::dot(row.toward, glm::normalize(row.center)), 1.0f, 1e-5f);
            EXPECT_NEAR(glm::dot(glm::cross(row.across, row.along), row.toward), 1.0f, 1e-5f);
        }
    }
}

TEST(CardRowsTest, DirectionsAreThoseOfTheStrands) {
    Groom straight;
    add_lock(straight, {}, 30, 2);
    for (const bool coils : {false, true}) {
        const StrandData strands = strands_of(coils ? coil_lock() : straight, kWidth);
        auto built = build_cards(strands, {.cards = 1, .along_ratio = 1.0f, .tip_scale = 1.0f});
        ASSERT_TRUE(built);
        const std::vector<StrandArea> rows = row_directions(built->cards);
        ASSERT_EQ(3 * rows.size(), built->cards.points.size());
        // A helix climbs by 1 / √(1 + (r turn / length)²) of its length.
        const float rise = coils ? kCoilRadius * kCoilTurn / kCoilLength : 0.0f;
        const float along = 1.0f / (1.0f + rise * rise);
        // A row sees a part of a turn, all of them together whole ones.
        float mean = 0.0f;
        for (const StrandArea& row : rows) {
            const float sum = row.diagonal.x + row.diagonal.y + row.diagonal.z;
            EXPECT_NEAR(sum, 1.0f, 1e-4f);
            EXPECT_NEAR(row.seen({0, 1, 0}), std::sqrt(row.diagonal.x + row.diagonal.z), 1e-4f);
            EXPECT_GT(row.seen({0, 0, 1}), coils ? 0.6f : 0.99f);
            mean += row.diagonal.y / static_cast<float>(rows.size());
        }
        EXPECT_NEAR(mean, along, coils ? 0.1f : 0.01f);
    }
}

TEST(CardBakeTest, OpacityAddsUpToTheAreaOfTheStrands) {
    // Flat locks in the XY plane, so that the plane of the card is that of the brute force; those
    // that fan out are the ones a mean centreline with a mean width would shrink.
    struct Case {
        float fan;
        int strands;
        float tip_scale;
    };
    for (const Case& c : {Case{1.0f, 10, 1.0f}, Case{3.0f, 40, 1.0f}, Case{6.0f, 80, 0.3f}}) {
        Groom groom;
        add_lock(groom, {.radius = 0.006f, .fan = c.fan, .flatness = 0.0f}, c.strands, 11);
        const StrandData strands = strands_of(groom, kWidth);
        auto built =
            build_cards(strands, {.cards = 1, .along_ratio = 0.3f, .tip_scale = c.tip_scale});
        ASSERT_TRUE(built) << built.error().message();
        const double expected = brute_force_area(strands, c.tip_scale);
        // Supersampling at 4 x 4 and texels as wide as a strand: 2 % in hundreds of texels.
        EXPECT_NEAR(card_area(built->cards), expected, 0.02 * expected) << c.fan;
    }
}

TEST(CardBakeTest, FibresAddUpToTheAreaOfTheStrandsWhetherSeenOrNot) {
    // Straight strands over each other, six layers of them, so that most cannot be seen.
    Groom groom;
    add_lock(groom, {.radius = 0.004f, .flatness = 0.5f}, 120, 5);
    const StrandData strands = strands_of(groom, kWidth);
    const auto built = build_cards(strands, {.cards = 1, .along_ratio = 0.3f, .tip_scale = 1.0f});
    ASSERT_TRUE(built) << built.error().message();
    double expected = 0.0;
    for (size_t s = 0; s < strands.strand_count(); ++s) {
        const glm::vec3 root = strands.positions[strands.strand_begin[s]];
        const glm::vec3 tip = strands.positions[strands.strand_begin[s + 1] - 1];
        expected += kWidth * glm::distance(root, tip);
    }
    EXPECT_LT(card_area(built->cards), 0.4 * expected);
    // As for the area: 2 %; the round ends of strands add half a percent.
    EXPECT_NEAR(card_area(built->cards, built->cards.atlas.fibres, 16.0), expected,
                0.025 * expected);
}

TEST(CardBakeTest, TangentsAreUnitAndDepthOrderIsTheStrands) {
    Groom groom;
    add_lock(groom, {.radius = 0.01f, .bend = 0.05f, .flatness = 0.6f, .curl = 0.002f}, 50, 5);
    const StrandData strands = strands_of(groom, kWidth);
    auto built = build_cards(strands, {.cards = 1});
    ASSERT_TRUE(built);
    const CardAtlas& atlas = built->cards.atlas;
    size_t deep = 0;
    for (size_t i = 0; i < atlas.texels(); ++i) {
        const glm::u8vec3 code = atlas.tangent[i];
        const glm::vec3 tangent(decode_signed(code.x), decode_signed(code.y),
                                decode_signed(code.z));
        // Three codes of 1/127 each: half a step an axis.
        EXPECT_NEAR(glm::length(tangent), 1.0f, 0.5f * std::sqrt(3.0f) / 127.0f + 1e-4f);
        deep += std::abs(decode_signed(atlas.depth[i])) > 0.3f ? 1 : 0;
    }
    EXPECT_GT(deep, atlas.texels() / 10) << "a thick lock has strands before and behind its middle";
}

TEST(CardBakeTest, TheNearerStrandIsSeen) {
    Groom groom;
    // Two strands that cross; the second one lies before the first.
    groom.points = {{-0.01f, 0, 0}, {0.01f, -0.1f, 0}, {0.01f, 0, 0.004f}, {-0.01f, -0.1f, 0.004f}};
    groom.strand_begin = {0, 2, 4};
    const StrandData strands = strands_of(groom, 0.002f);
    const std::vector<uint32_t> members = {0, 1};
    const Ribbon ribbon = fit_ribbon(strands, members, {});
    const CardAtlas card = bake_card(strands, members, ribbon, {.size = {64, 64}});
    const float towards_z = ribbon.rows[0].toward.z;
    const size_t middle = 32 * 64 + 32;
    EXPECT_EQ(card.strand[middle], towards_z > 0.0f ? 1 : 0);
    EXPECT_GT(decode_signed(card.depth[middle]), 0.0f);
    EXPECT_EQ(card.opacity[middle], 255);
    EXPECT_EQ(card.fibres[middle], 2 * 16);
}

TEST(CardBuildTest, StoutCardsBecomeMore) {
    struct Case {
        float length;
        uint32_t strands;
        uint32_t cards;
    };
    // The last has too few strands for 900 cards: each gets its own.
    for (const Case& c : {Case{0.3f, 3000, 300}, Case{0.08f, 3000, 900}, Case{0.035f, 4000, 1200},
                          Case{0.01f, 12'000, 4000}, Case{0.08f, 2000, 2000}}) {
        Groom groom;
        for (uint32_t strand = 0; strand < c.strands; ++strand) {
            vellus::test::Random random(4, strand);
            const glm::vec3 root(random.range(-0.15, 0.15), 0.0, random.range(-0.15, 0.15));
            add_strand(groom, {root, root + glm::vec3(0.0f, 0.5f * c.length, 0.0f),
                               root + glm::vec3(0.0f, c.length, 0.0f)});
        }
        const StrandData strands = strands_of(groom, kWidth);
        const auto chosen = build_cards(strands, {.max_texels = 1U << 18U, .samples = 1});
        const auto few =
            build_cards(strands, {.cards = 300, .max_texels = 1U << 18U, .samples = 1});
        ASSERT_TRUE(chosen && few);
        // 300 squares that tile the ground have half a side of 0.0087 m, which strands do not fill.
        EXPECT_LT(few->report.stoutness * c.length, 0.0087f);
        EXPECT_GT(few->report.stoutness * c.length, 0.003f);
        EXPECT_EQ(few->report.cards, 300U);
        EXPECT_EQ(chosen->report.cards, c.cards) << c.length;
        EXPECT_LE(chosen->report.stoutness, few->report.stoutness);
    }
}

TEST(CardBuildTest, GatheredHairGetsMoreCards) {
    // Straight strands that keep this share of their distances at their tips.
    for (const float kept : {1.0f, 0.0f}) {
        Groom groom;
        for (uint32_t strand = 0; strand < 2800; ++strand) {
            vellus::test::Random random(4, strand);
            const glm::vec3 root(random.range(-0.1, 0.1), 0.0, random.range(-0.1, 0.1));
            const glm::vec3 tip = kept * root + glm::vec3(0.0f, 0.4f, 0.0f);
            add_strand(groom, {root, 0.5f * (root + tip), tip});
        }
        const StrandData strands = strands_of(groom, kWidth);
        const auto chosen = build_cards(strands, {.max_texels = 1U << 16U});
        const auto few = build_cards(strands, {.cards = 300, .max_texels = 1U << 16U});
        ASSERT_TRUE(chosen && few);
        // Rows are an eighth of the length apart and as wide as the strands at the row before, so
        // the mean width is that of an eighth nearer to the root.
        const float mean = 0.5f * (1.0f + kept) + 0.125f * (1.0f - kept);
        EXPECT_NEAR(few->report.gathering, 1.0f / mean, 0.03f);
        EXPECT_EQ(few->report.cards, 300U);
        EXPECT_EQ(chosen->report.cards, kept > 0.0f ? 300U : 900U);
    }
}

TEST(CardBuildTest, TheSameBytesOnAnyNumberOfCores) {
    const StrandData strands = strands_of(head_of_locks(12, 40), kWidth);
    auto first = build_cards(strands, {.cards = 24});
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    auto second = build_cards(strands, {.cards = 24});
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->cards.points, second->cards.points);
    EXPECT_EQ(first->cards.uvs, second->cards.uvs);
    EXPECT_EQ(first->cards.triangles, second->cards.triangles);
    EXPECT_EQ(first->cards.parameters, second->cards.parameters);
    EXPECT_EQ(first->cards.card_begin, second->cards.card_begin);
    EXPECT_EQ(first->cards.atlas.opacity, second->cards.atlas.opacity);
    EXPECT_EQ(first->cards.atlas.depth, second->cards.atlas.depth);
    EXPECT_EQ(first->cards.atlas.tangent, second->cards.atlas.tangent);
    EXPECT_EQ(first->cards.atlas.strand, second->cards.atlas.strand);
    EXPECT_EQ(first->cards.card_count(), 24u);
}

TEST(CardBuildTest, EveryStrandIsInTheAtlas) {
    const StrandData strands = strands_of(head_of_locks(4, 10), kWidth);
    auto built = build_cards(strands, {.cards = 8});
    ASSERT_TRUE(built);
    std::set<uint16_t> seen;
    for (size_t i = 0; i < built->cards.atlas.texels(); ++i) {
        if (built->cards.atlas.opacity[i] > 0) seen.insert(built->cards.atlas.strand[i]);
    }
    EXPECT_EQ(seen.size(), strands.strand_count());
}

TEST(CardBuildTest, TheAtlasKeepsItsLimit) {
    const StrandData strands = strands_of(head_of_locks(8, 30), kWidth);
    auto built =
        build_cards(strands, {.cards = 16, .texels_per_metre = 1e5f, .max_texels = 100'000});
    ASSERT_TRUE(built);
    // Shelves leave some of it empty.
    EXPECT_LT(built->cards.atlas.texels(), 150'000u);
    EXPECT_EQ(built->report.bytes, built->cards.bytes());
}

TEST(CardBuildTest, SaysWhatIsWrong) {
    const StrandData strands = strands_of(head_of_locks(1, 3), kWidth);
    const auto message = [&](const StrandData& from, const CardBuildOptions& options) {
        const auto built = build_cards(from, options);
        return built ? std::string() : built.error().message();
    };
    EXPECT_NE(message(StrandData{}, {}).find("no strands"), std::string::npos);
    EXPECT_NE(message(strands, {.cards = 65537}).find("1 to 65536"), std::string::npos);
    EXPECT_NE(message(strands, {.along_ratio = 2.0f}).find("0.01 to 1"), std::string::npos);
    EXPECT_NE(message(strands, {.samples = 0}).find("1 to 16"), std::string::npos);
    EXPECT_NE(message(strands, {.max_rows = 1}).find("2 to 64"), std::string::npos);
    EXPECT_NE(message(strands, {.texels_per_metre = NAN}).find("texels per metre"),
              std::string::npos);
}

TEST(CardAtlasTest, EveryLevelKeepsTheMeanOpacity) {
    const StrandData strands = strands_of(head_of_locks(5, 30), kWidth);
    auto built = build_cards(strands, {.cards = 5});
    ASSERT_TRUE(built);
    const CardAtlas& atlas = built->cards.atlas;
    const AtlasLevels levels = make_levels(atlas);
    size_t first = 0;
    double mean0 = 0.0;
    double fibres0 = 0.0;
    for (uint32_t level = 0; level < kCardLevels; ++level) {
        const glm::uvec2 size = level_size(atlas, level);
        const size_t count = size_t{size.x} * size.y;
        double sum = 0.0;
        for (size_t i = first; i < first + count; ++i) sum += levels.shape[i] & 0xffU;
        const double mean = sum / static_cast<double>(count);
        double fibres = 0.0;
        for (size_t i = first; i < first + count; ++i) fibres += levels.fibres[i];
        fibres /= static_cast<double>(count);
        if (level == 0) mean0 = mean;
        if (level == 0) fibres0 = fibres;
        EXPECT_NEAR(fibres, fibres0, 0.25) << level;
        // Rounding to a byte: half a step at most in each level, and both ways.
        EXPECT_NEAR(mean, mean0, 0.25) << level;
        first += count;
    }
    EXPECT_EQ(first, levels.shape.size());
    EXPECT_GT(mean0, 10.0);
}

TEST(CardAtlasTest, HairThatCrossesKeepsItsDirections) {
    CardAtlas atlas{.width = 2, .height = 2};
    atlas.opacity = {100, 200, 100, 0};
    atlas.depth = {128, 128, 128, 128};
    // Across, back, and across again: their mean would lead along the card.
    const glm::u8vec3 there(251, 156, 128);
    const glm::u8vec3 back(5, 156, 128);
    atlas.tangent = {there, back, there, there};
    const AtlasLevels levels = make_levels(atlas);
    EXPECT_EQ(levels.strand[4] & 0xffffffU, 5U | 156U << 8U | 128U << 16U);
}

TEST(CardPackTest, RectanglesNeitherOverlapNorLeaveTheAtlas) {
    std::mt19937 random(4);
    std::vector<glm::uvec2> sizes;
    sizes.reserve(300);
    for (int i = 0; i < 300; ++i) {
        sizes.emplace_back(16 * (1 + random() % 8), 16 * (1 + random() % 20));
    }
    const Packing packing = pack_shelves(sizes);
    std::vector<uint8_t> used(size_t{packing.size.x / 16} * (packing.size.y / 16), 0);
    uint64_t area = 0;
    for (size_t i = 0; i < sizes.size(); ++i) {
        ASSERT_LE(packing.corners[i].x + sizes[i].x, packing.size.x);
        ASSERT_LE(packing.corners[i].y + sizes[i].y, packing.size.y);
        area += uint64_t{sizes[i].x} * sizes[i].y;
        for (uint32_t y = 0; y < sizes[i].y / 16; ++y) {
            for (uint32_t x = 0; x < sizes[i].x / 16; ++x) {
                const glm::uvec2 cell = packing.corners[i] / 16U + glm::uvec2(x, y);
                uint8_t& cell_used = used[size_t{cell.y} * (packing.size.x / 16) + cell.x];
                EXPECT_EQ(cell_used, 0);
                cell_used = 1;
            }
        }
    }
    EXPECT_GT(static_cast<double>(area), 0.85 * packing.size.x * packing.size.y);
}

}  // namespace
}  // namespace vellus::hair
