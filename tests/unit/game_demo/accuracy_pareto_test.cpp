#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "game_demo/src/accuracy/pareto.h"
#include "tests/support/sampling.h"

namespace vellus::demo {
namespace {

TEST(Pareto, KeepsWhatNothingElseBeats) {
    const std::vector<CostAndError> points = {{3, 1}, {1, 5}, {2, 5}, {2, 3}, {4, 1}, {5, 0}};
    EXPECT_EQ(pareto_front(points), (std::vector<size_t>{1, 3, 0, 5}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Pareto, OfEqualPointsTheFirst) {
    const std::vector<CostAndError> points = {{1, 1}, {1, 1}, {1, 2}};
    EXPECT_EQ(pareto_front(points), std::vector<size_t>{0});
}

TEST(Pareto, WhatIsNotFiniteIsNoPoint) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    const std::vector<CostAndError> points = {{nan, 0}, {0, nan}, {infinite, 0}, {2, 2}};
    EXPECT_EQ(pareto_front(points), std::vector<size_t>{3});
}

TEST(Pareto, AgreesWithComparingAllPairs) {
    for (uint64_t round = 0; round < 200; ++round) {
        test::Random random(3, round);
        std::vector<CostAndError> points;
        points.reserve(40);
        // Coarse numbers, so that costs and errors coincide.
        for (int i = 0; i < 40; ++i) {
            points.push_back({std::floor(12 * random.unit()), std::floor(12 * random.unit())});
        }
        const auto front = pareto_front(points);
        for (size_t i = 0; i < points.size(); ++i) {
            const bool beaten = std::ranges::any_of(points, [&](const CostAndError& other) {
                return other.cost <= points[i].cost && other.error <= points[i].error &&
                       (other.cost < points[i].cost || other.error < points[i].error);
            });
            const bool there = std::ranges::any_of(front, [&](size_t k) {
                return points[k].cost == points[i].cost && points[k].error == points[i].error;
            });
            EXPECT_EQ(there, !beaten) << round << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace vellus::demo
