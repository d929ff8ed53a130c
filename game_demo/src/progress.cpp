#include "game_demo/src/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "engine/platform/clock.h"

namespace vellus::demo {

namespace {
constexpr uint32_t kBarWidth = 30;
}

Progress::Progress(uint32_t total, const char* unit, uint32_t first)
    : total_(total),
      unit_(unit),
      first_(first),
      start_(wall_seconds()),
      visible_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (visible_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(uint32_t done) {
    if (!visible_ || done <= first_) return;
    const auto filled = static_cast<uint32_t>(uint64_t{kBarWidth} * done / total_);
    const double seconds = wall_seconds() - start_;
    fmt::print(stderr, "\r\033[K[{:#>{}}{:.>{}}] {}/{} {}, {:.0f} s left", "", filled, "",
               kBarWidth - filled, done, total_, unit_,
               seconds / (done - first_) * (total_ - done));
    std::fflush(stderr);
}

}  // namespace vellus::demo
