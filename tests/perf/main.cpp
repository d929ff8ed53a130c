#include <algorithm>

#include "tests/perf/bench.h"

namespace vellus::bench {

std::vector<Benchmark>& benchmarks() {
    static std::vector<Benchmark> all;
    return all;
}

}  // namespace vellus::bench

int main(int argc, char** argv) {
    using vellus::bench::Benchmark;
    auto& all = vellus::bench::benchmarks();
    std::sort(all.begin(), all.end(),
              [](const Benchmark& a, const Benchmark& b) { return a.name < b.name; });

    CLI::App app("Vellus benchmarks: each prints what it measured, and verifies what it computed");
    app.require_subcommand(1);
    std::function<int()> run;
    for (const Benchmark& benchmark : all) {
        CLI::App* const command = app.add_subcommand(benchmark.name, benchmark.help);
        command->callback([&run, chosen = benchmark.set_up(*command)] { run = chosen; });
    }
    CLI11_PARSE(app, argc, argv);
    return run();
}
