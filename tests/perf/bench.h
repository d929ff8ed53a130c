#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::bench {

/// One subcommand of vellus_bench. `set_up` declares its options and returns what runs it, whose
/// result is the exit status; state that both need lives in a shared_ptr the function captures.
struct Benchmark {
    std::string name;
    std::string help;
    std::function<std::function<int()>(CLI::App&)> set_up;
};

std::vector<Benchmark>& benchmarks();

/// A file NAME_bench.cpp registers its subcommand with one of these at namespace scope.
struct Registration {
    explicit Registration(Benchmark benchmark) { benchmarks().push_back(std::move(benchmark)); }
};

/// 0, or 1 and the error on stderr.
int exit_status(const Result<void>& done);

}  // namespace vellus::bench
