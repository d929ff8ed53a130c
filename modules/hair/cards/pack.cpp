#include "modules/hair/cards/pack.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vellus::hair {

namespace {

uint32_t aligned(double value) {
    const double steps = std::ceil(value / kCardAlignment);
    return static_cast<uint32_t>(steps) * kCardAlignment;
}

}  // namespace

Packing pack_shelves(std::span<const glm::uvec2> sizes) {
    Packing packing;
    packing.corners.resize(sizes.size());
    double area = 0.0;
    for (const glm::uvec2 size : sizes) {
        area += static_cast<double>(size.x) * size.y;
        packing.size.x = std::max(packing.size.x, size.x);
    }
    packing.size.x = std::max(packing.size.x, aligned(std::sqrt(area)));
    std::vector<uint32_t> order(sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order,
                             [&](uint32_t a, uint32_t b) { return sizes[a].y > sizes[b].y; });
    glm::uvec2 corner(0);
    uint32_t shelf = 0;
    for (const uint32_t i : order) {
        if (corner.x + sizes[i].x > packing.size.x) {
            corner = {0, corner.y + shelf};
            shelf = 0;
        }
        packing.corners[i] = corner;
        corner.x += sizes[i].x;
        shelf = std::max(shelf, sizes[i].y);
    }
    packing.size.y = corner.y + shelf;
    return packing;
}

}  // namespace vellus::hair
