#include "modules/hair/reference/tracer/render.h"

#include <algorithm>

#include "engine/platform/jobs.h"

namespace vellus::hair::tracer {

namespace {
constexpr uint32_t kTile = 16;
}

void add_samples(const PathTracer& tracer, uint64_t seed, uint32_t until, Film& film,
                 const std::atomic<bool>& stop) {
    const glm::uvec2 size = film.size();
    const glm::uvec2 tiles = (size + kTile - 1u) / kTile;
    parallel_ranges(size_t{tiles.x} * tiles.y, 1, [&](size_t first, size_t last) {
        for (size_t tile = first; tile < last && !stop; ++tile) {
            const glm::uvec2 low = glm::uvec2(tile % tiles.x, tile / tiles.x) * kTile;
            const glm::uvec2 high = glm::min(low + kTile, size);
            for (uint32_t y = low.y; y < high.y; ++y) {
                for (uint32_t x = low.x; x < high.x; ++x) {
                    const uint32_t pixel = y * size.x + x;
                    while (film.count(pixel) < until) {
                        film.add(pixel, tracer.sample({x, y}, size,
                                                      Random(seed, pixel, film.count(pixel))));
                    }
                }
            }
        }
    });
}

}  // namespace vellus::hair::tracer
