#pragma once

#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace vellus::bench {

/// One side of a case: times its work and then checks every entity.
struct Timed {
    double seconds;
    bool verified;
};

struct EcsCase {
    double target;  ///< Vellus may take this many times as long as the hand-written side.
    size_t visits;  ///< Entities touched in one run: the divisor of "ns per entity".
    std::function<Timed()> vellus;
    std::function<Timed()> by_hand;
};

/// Makes a case when its turn comes, so that only one case's entities are in memory.
struct EcsCaseMaker {
    std::string name;
    std::function<EcsCase()> make;
};

std::vector<EcsCaseMaker> iteration_cases(bool quick);
std::vector<EcsCaseMaker> structure_cases(bool quick);

/// CPU time of this thread: what other programs do to the machine's cores stays out of it.
inline double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

template <class Work>
double seconds_of(const Work& work) {
    const double start = thread_seconds();
    work();
    return thread_seconds() - start;
}

}  // namespace vellus::bench
