#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace vellus {

/// The value below which a share in [0, 1] of the samples lies, between neighbours in proportion;
/// `sorted` ascends and is not empty.
inline double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<size_t>(at);
    const size_t high = std::min(low + 1, sorted.size() - 1);
    return std::lerp(sorted[low], sorted[high], at - std::floor(at));
}

}  // namespace vellus
