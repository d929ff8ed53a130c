#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "tests/perf/bench.h"
#include "tests/perf/ecs_cases.h"

namespace vellus::bench {
namespace {

struct Options {
    bool quick = false;
    int rounds = 0;
    std::string only;
};

struct Measured {
    double vellus_ns;
    double hand_ns;
    bool verified;
};

/// The two sides take turns, so that both see the same disturbances; the best of each counts.
Measured measure(const EcsCase& one, int rounds) {
    constexpr double kNanoseconds = 1e9;
    Timed vellus{std::numeric_limits<double>::max(), true};
    Timed by_hand = vellus;
    const auto keep_best = [](Timed& best, const Timed& timed) {
        best.seconds = std::min(best.seconds, timed.seconds);
        best.verified &= timed.verified;
    };
    for (int round = 0; round < rounds; ++round) {
        keep_best(vellus, one.vellus());
        keep_best(by_hand, one.by_hand());
    }
    const double scale = kNanoseconds / static_cast<double>(one.visits);
    return {vellus.seconds * scale, by_hand.seconds * scale, vellus.verified && by_hand.verified};
}

int run(const Options& options) {
    const int quick_rounds = 3;
    const int full_rounds = 9;
    int rounds = options.rounds;
    if (rounds == 0) rounds = options.quick ? quick_rounds : full_rounds;

    std::vector<EcsCaseMaker> makers = iteration_cases(options.quick);
    std::ranges::move(structure_cases(options.quick), std::back_inserter(makers));
    bool all_verified = true;
    fmt::print("{:<44} {:>10} {:>10} {:>7} {:>8}\n", "ns per entity, best of turns", "Vellus",
               "by hand", "ratio", "target");
    for (const auto& [name, make] : makers) {
        if (name.find(options.only) == std::string::npos) continue;
        const EcsCase one = make();
        const Measured measured = measure(one, rounds);
        const double ratio = measured.vellus_ns / measured.hand_ns;
        const char* const verdict = !measured.verified    ? "  WRONG RESULT"
                                    : ratio <= one.target ? ""
                                                          : "  missed";
        fmt::print("{:<44} {:>10.3f} {:>10.3f} {:>7.2f} {:>8}{}\n", name, measured.vellus_ns,
                   measured.hand_ns, ratio, fmt::format("<= {:.1f}", one.target), verdict);
        std::fflush(stdout);
        all_verified &= measured.verified;
    }
    return all_verified ? 0 : 1;
}

const Registration kEcs(
    {"ecs", "ECS against hand-written loops and archetype tables", [](CLI::App& app) {
         const auto options = std::make_shared<Options>();
         app.add_flag("--quick", options->quick, "Fewer entities and turns");
         app.add_option("--rounds", options->rounds, "Turns per side")->check(CLI::Range(1, 1000));
         app.add_option("--only", options->only, "Cases whose name has this");
         return [options] { return run(*options); };
     }});

}  // namespace
}  // namespace vellus::bench
