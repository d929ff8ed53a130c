#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/perf/timed_work.h"

namespace vellus::bench {

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

}  // namespace vellus::bench
