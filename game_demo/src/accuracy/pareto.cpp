#include "game_demo/src/accuracy/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vellus::demo {

std::vector<size_t> pareto_front(std::span<const CostAndError> points) {
    std::vector<size_t> order;
    for (size_t i = 0; i < points.size(); ++i) {
        if (std::isfinite(points[i].cost) && std::isfinite(points[i].error)) order.push_back(i);
    }
    std::ranges::sort(order, {},
                      [&](size_t i) { return std::tuple(points[i].cost, points[i].error, i); });
    std::vector<size_t> front;
    for (const size_t i : order) {
        if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
    }
    return front;
}

}  // namespace vellus::demo
