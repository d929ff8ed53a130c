#include <gtest/gtest.h>

#include <vector>

#include "modules/temporal/temporal.h"

namespace vellus::temporal {
namespace {

/// How often each pixel of a picture is resolved.
std::vector<int> resolved(const TaaRegions& regions, const glm::ivec2& size) {
    std::vector<int> times(static_cast<size_t>(size.x) * size.y);
    const auto count = [&](const scene::PixelRect& region) {
        for (int y = region.first.y; y < region.end.y; ++y) {
            for (int x = region.first.x; x < region.end.x; ++x) ++times.at(y * size.x + x);
        }
    };
    count(regions.hair);
    for (const scene::PixelRect& region : regions.others) {
        if (!region.empty()) count(region);
    }
    return times;
}

TEST(TaaRegions, EveryPixelIsResolvedOnceAndThoseNearHairAsSuch) {
    const glm::ivec2 size(75, 50);
    const scene::PixelRect rects[] = {{},
                                      {{20, 20}, {30, 25}},
                                      {{0, 0}, {75, 50}},
                                      {{0, 10}, {5, 12}},
                                      {{74, 49}, {75, 50}},
                                      {{16, 0}, {48, 50}}};
    for (const scene::PixelRect& hair : rects) {
        const TaaRegions regions = cut_regions(hair, size);
        EXPECT_EQ(resolved(regions, size), std::vector<int>(size_t{75} * 50, 1));
        EXPECT_EQ(regions.hair.empty(), hair.empty());
        if (hair.empty()) continue;
        EXPECT_LE(regions.hair.first.x, std::max(hair.first.x - 2, 0));
        EXPECT_LE(regions.hair.first.y, std::max(hair.first.y - 2, 0));
        EXPECT_GE(regions.hair.end.x, std::min(hair.end.x + 2, size.x));
        EXPECT_GE(regions.hair.end.y, std::min(hair.end.y + 2, size.y));
    }
}

}  // namespace
}  // namespace vellus::temporal
