#pragma once

#include <cstdint>

namespace vellus::bench {

/// Calls of operator new in this program so far, from all threads.
uint64_t allocations();

}  // namespace vellus::bench
