#include "modules/hair/groom/upright.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/hair/groom/groom_file.h"
#include "tests/unit/hair/groom/sample_groom.h"

namespace vellus::hair {
namespace {

/// Hair on a half-sphere of `radius` around the origin, hanging down by `length`. `up` and `front`
/// are axes; the hairline is high in front.
Groom head(GroomFormat format, glm::vec3 up, glm::vec3 front, float radius, float length) {
    const glm::vec3 right = glm::cross(up, front);
    Groom groom;
    groom.format = format;
    for (int ring = 0; ring < 8; ++ring) {
        const float height = static_cast<float>(ring) / 8.0f;
        for (int i = 0; i < 64; ++i) {
            const float angle = static_cast<float>(i) / 32.0f * std::numbers::pi_v<float>;
            if (std::cos(angle) > 0.7f && height < 0.6f) continue;  // the face
            const float flat = std::sqrt(1.0f - height * height);
            const glm::vec3 root = radius * (height * up + flat * std::cos(angle) * front +
                                             flat * std::sin(angle) * right);
            groom.points.push_back(root);
            groom.points.push_back(root - length * up);
            groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
        }
    }
    return groom;
}

void expect_stands(const Groom& groom, glm::vec3 up, glm::vec3 front, double metres_per_unit) {
    const Upright upright = upright_transform(groom);
    const glm::dmat3 turn = glm::dmat3(upright.to_metres);
    EXPECT_NEAR(upright.metres_per_unit, metres_per_unit, 1e-3 * metres_per_unit) << upright.reason;
    const glm::dvec3 y = turn * glm::dvec3(up) / upright.metres_per_unit;
    const glm::dvec3 z = turn * glm::dvec3(front) / upright.metres_per_unit;
    EXPECT_LT(glm::distance(y, glm::dvec3(0, 1, 0)), 1e-9) << upright.reason;
    EXPECT_LT(glm::distance(z, glm::dvec3(0, 0, 1)), 1e-9) << upright.reason;
    EXPECT_NEAR(glm::determinant(turn), std::pow(upright.metres_per_unit, 3), 1e-12);
}

TEST(Upright, HairFilesAreZUpAndFaceTheirHighHairline) {
    const glm::vec3 z(0, 0, 1);
    for (const glm::vec3 front :
         {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0)}) {
        expect_stands(head(GroomFormat::kHair, z, front, 8.0f, 20.0f), z, front, 0.01);
    }
}

TEST(Upright, HairThatHangsAlongMinusYIsYUp) {
    const glm::vec3 y(0, 1, 0);
    for (const glm::vec3 front : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1)}) {
        expect_stands(head(GroomFormat::kHair, y, front, 8.0f, 20.0f), y, front, 0.01);
    }
}

TEST(Upright, ScalpOfNoHumanSetsTheUnit) {
    const glm::vec3 z(0, 0, 1);
    const glm::vec3 y(0, 1, 0);
    // The roots span 2 radii sideways and, without the face, 1.7 to 2 from back to front.
    const Upright upright = upright_transform(head(GroomFormat::kHair, z, y, 21.0f, 80.0f));
    const glm::dvec3 scalp = upright.scalp_high - upright.scalp_low;
    EXPECT_NEAR((scalp.x + scalp.z) / 2.0, 0.17, 1e-6);
    EXPECT_GT(upright.metres_per_unit, 0.17 / (2.0 * 21.0));
    EXPECT_LT(upright.metres_per_unit, 0.17 / (1.85 * 21.0));
}

TEST(Upright, TressFxStaysInMetresUnlessItsSizeIsAbsurd) {
    const glm::vec3 y(0, 1, 0);
    const glm::vec3 z(0, 0, 1);
    expect_stands(head(GroomFormat::kTfx4, y, z, 0.09f, 0.3f), y, z, 1.0);
    const Upright large = upright_transform(head(GroomFormat::kTfx4, y, z, 50.0f, 100.0f));
    EXPECT_NEAR((large.scalp_high - large.scalp_low).x, 0.17, 0.02);
}

TEST(Upright, EmptyAndPointlikeGroomsGetAFiniteTransform) {
    for (const auto& counts : {std::vector<uint32_t>{}, std::vector<uint32_t>{1}}) {
        const Groom groom = test::random_groom(counts);
        const Upright upright = upright_transform(groom);
        EXPECT_GT(upright.metres_per_unit, 0.0);
        EXPECT_TRUE(std::isfinite(glm::determinant(upright.to_metres)));
        EXPECT_GT(default_width(groom, upright.metres_per_unit), 0.0);
    }
}

TEST(DefaultWidth, ComesFromTheFileElseCoversTheSilhouette) {
    Groom groom = head(GroomFormat::kHair, {0, 0, 1}, {0, 1, 0}, 8.0f, 20.0f);
    groom.default_thickness = 0.1f;
    EXPECT_NEAR(default_width(groom, 0.01), 1e-3, 1e-9);
    groom.thickness.assign(groom.points.size(), 0.02f);
    EXPECT_NEAR(default_width(groom, 0.01), 2e-4, 1e-9);

    // 100 strands of 1 m in a box of 1 x 1 x 1: 8 pi / 4 / 100 m is far too thick, so the limit.
    Groom bare;
    for (int i = 0; i < 100; ++i) {
        const float x = static_cast<float>(i % 10) / 9.0f;
        const int row = i / 10;
        const float z = static_cast<float>(row) / 9.0f;
        bare.points.insert(bare.points.end(), {{x, 1, z}, {x, 0, z}});
        bare.strand_begin.push_back(static_cast<uint32_t>(bare.points.size()));
    }
    EXPECT_DOUBLE_EQ(default_width(bare, 1.0), 1.5e-3);
    // At a thousandth of the size the box shrinks with the square: 8 pi / 4 * 1e-6 / 0.1 m.
    EXPECT_NEAR(default_width(bare, 1e-3), 8.0 * std::numbers::pi / 4.0 * 1e-6 / 0.1, 1e-12);
}

}  // namespace
}  // namespace vellus::hair
