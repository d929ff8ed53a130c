#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "tests/perf/bench.h"

namespace vellus::bench {

std::vector<Benchmark>& benchmarks() {
    static std::vector<Benchmark> all;
    return all;
}

int exit_status(const Result<void>& done) {
    if (!done) fmt::print(stderr, "error: {}\n", done.error().message());
    return done ? 0 : 1;
}

}  // namespace vellus::bench

namespace {

int run(int argc, char** argv) {
    using vellus::bench::Benchmark;
    auto& all = vellus::bench::benchmarks();
    std::sort(all.begin(), all.end(),
              [](const Benchmark& a, const Benchmark& b) { return a.name < b.name; });

    CLI::App app("Vellus benchmarks: each prints what it measured, and verifies what it computed");
    app.require_subcommand(1);
    std::function<int()> chosen;
    for (const Benchmark& benchmark : all) {
        CLI::App* const command = app.add_subcommand(benchmark.name, benchmark.help);
        command->callback([&chosen, work = benchmark.set_up(*command)] { chosen = work; });
    }
    CLI11_PARSE(app, argc, argv);
    return chosen();
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fputs(error.what(), stderr);
        return 1;
    }
}
