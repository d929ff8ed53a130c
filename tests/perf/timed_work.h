#pragma once

#include <ctime>

#include "engine/platform/clock.h"

namespace vellus::bench {

/// One round of a case: times its work and then checks what it made.
struct Timed {
    double seconds;
    bool verified;
};

/// CPU time of this thread: what other programs do to the machine's cores stays out of it.
inline double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

inline void keep_busy(double milliseconds) {
    const double end = thread_seconds() + 1e-3 * milliseconds;
    while (thread_seconds() < end) {
    }
}

/// Milliseconds wasted in all timed work, to see compare catch it.
inline double& injected_ms() {
    static double milliseconds = 0.0;
    return milliseconds;
}

/// CPU seconds of this thread's work.
template <class Work>
double seconds_of(const Work& work) {
    const double start = thread_seconds();
    work();
    if (injected_ms() > 0.0) keep_busy(injected_ms());
    return thread_seconds() - start;
}

/// Wall seconds, for work on all cores.
template <class Work>
double wall_seconds_of(const Work& work) {
    const double start = wall_seconds();
    work();
    if (injected_ms() > 0.0) keep_busy(injected_ms());
    return wall_seconds() - start;
}

}  // namespace vellus::bench
