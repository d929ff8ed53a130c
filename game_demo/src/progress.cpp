#include "game_demo/src/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "engine/platform/clock.h"

namespace vellus::demo {

namespace {
constexpr uint32_t kBarWidth = 30;
constexpr double kQuiet = 60.0;  // seconds between lines of a log
}  // namespace

Progress::Progress(uint32_t total, const char* unit, uint32_t first)
    : total_(total),
      unit_(unit),
      first_(first),
      start_(wall_seconds()),
      said_(start_),
      visible_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (visible_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(uint32_t done) {
    if (done <= first_) return;
    const double now = wall_seconds();
    const double left = (now - start_) / (done - first_) * (total_ - done);
    if (!visible_) {
        if (now - said_ < kQuiet) return;
        said_ = now;
        fmt::print(stderr, "{}/{} {}, {:.0f} s left\n", done, total_, unit_, left);
        return;
    }
    const auto filled = static_cast<uint32_t>(uint64_t{kBarWidth} * done / total_);
    fmt::print(stderr, "\r\033[K[{:#>{}}{:.>{}}] {}/{} {}, {:.0f} s left", "", filled, "",
               kBarWidth - filled, done, total_, unit_, left);
    std::fflush(stderr);
}

}  // namespace vellus::demo
