#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vellus::demo {

/// What something costs and how wrong it is.
struct CostAndError {
    double cost = 0.0;
    double error = 0.0;
};

/// Indices of the points that no other beats: none costs as little with less error, nor is as good
/// for less. By rising cost, so by falling error; of equal points the first. Points that are not
/// finite are never among them.
std::vector<size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace vellus::demo
