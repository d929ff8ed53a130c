#include "game_demo/src/ground.h"

#include <gtest/gtest.h>

namespace vellus::demo {
namespace {

/// A slope y = x / 2 over [0, 4] x [0, 4], a slab at y = 3 above part of it, and a wall.
Ground hill() {
    Ground ground;
    ground.add({0, 0, 0}, {0, 0, 4}, {4, 2, 4});
    ground.add({0, 0, 0}, {4, 2, 4}, {4, 2, 0});
    ground.add({0, 3, 0}, {0, 3, 1}, {1, 3, 0});
    ground.add({2, 0, 0}, {2, 9, 0}, {2, 0, 4});
    return ground;
}

TEST(Ground, HeightIsThatOfTheSurfaceBelowTheFeet) {
    const Ground ground = hill();
    for (const double x : {0.1, 1.3, 2.0, 3.9}) {
        EXPECT_NEAR(*ground.height(x, 2.2, 10.0), 0.5 * x, 1e-12) << x;
    }
}

TEST(Ground, ARoofIsNoGroundForWhoStandsBelowIt) {
    const Ground ground = hill();
    EXPECT_NEAR(*ground.height(0.2, 0.2, 2.5), 0.1, 1e-12);
    EXPECT_NEAR(*ground.height(0.2, 0.2, 3.5), 3.0, 1e-12);
}

TEST(Ground, BesideItThereIsNone) {
    EXPECT_FALSE(hill().height(-0.1, 2.0, 10.0));
    EXPECT_FALSE(Ground().height(0.0, 0.0, 10.0));
    EXPECT_FALSE(hill().height(1.0, 2.0, 0.2)) << "all of it is above";
}

}  // namespace
}  // namespace vellus::demo
