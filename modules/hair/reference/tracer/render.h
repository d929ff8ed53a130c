#pragma once

#include <atomic>

#include "modules/hair/reference/tracer/film.h"

namespace vellus::hair::tracer {

/// Adds samples to every pixel that has fewer than `until`, on all cores; ends early, with whole
/// pixels, once `stop` is set. The sums depend on seed and sample numbers alone.
void add_samples(const PathTracer& tracer, uint64_t seed, uint32_t until, Film& film,
                 const std::atomic<bool>& stop);

}  // namespace vellus::hair::tracer
