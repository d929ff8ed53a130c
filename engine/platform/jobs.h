#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace vellus {

/// Calls `body(first, last)` on disjoint ranges that cover [0, count), on all cores (oneTBB).
template <class Body>
void parallel_ranges(size_t count, size_t grain, const Body& body) {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<size_t>(0, count, grain),
                              [&](const auto& range) { body(range.begin(), range.end()); });
}

}  // namespace vellus
