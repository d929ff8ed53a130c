#include <fmt/format.h>

#include <memory>

#include "tests/perf/bench.h"
#include "tests/perf/report/compare.h"

namespace vellus::bench {

namespace {

struct Options {
    std::string before;
    std::string after;
    Tolerances tolerances;
    bool all = false;
};

const char* word(const Comparison& row) {
    const bool time = row.unit == "ms";
    switch (row.change) {
        case Change::kSame:
            return "";
        case Change::kBetter:
            return time ? "FASTER" : "smaller";
        case Change::kWorse:
            return time ? "SLOWER" : "LARGER";
        case Change::kNew:
            return "new";
        case Change::kGone:
            return "gone";
    }
    return "";
}

void print_hashes(const Report& before, const Report& after) {
    for (const auto& [scene, hash] : before.hashes) {
        const auto now = after.hashes.find(scene);
        if (now == after.hashes.end() || now->second == hash) continue;
        fmt::print("{}: another picture ({} before, {} now)\n", scene, hash, now->second);
    }
}

int run_compare(const Options& options) {
    const auto before = load_report(options.before);
    const auto after = load_report(options.after);
    for (const auto* report : {&before, &after}) {
        if (*report) continue;
        fmt::print(stderr, "error: {}\n", report->error().message());
        return 2;
    }
    const auto rows = compare(*before, *after, options.tolerances);
    fmt::print("calibration {:.2f} ms ({}), {:.2f} ms ({})\n", before->calibration.median,
               before->device, after->calibration.median, after->device);
    fmt::print("{:<44} {:>12} {:>12} {:>7} {:>7}\n", "", "before", "after", "ratio", "beyond");
    size_t same = 0;
    for (const Comparison& row : rows) {
        if (row.change == Change::kSame) ++same;
        if (row.change == Change::kSame && !options.all) continue;
        fmt::print("{:<44} {:>12.2f} {:>12.2f} {:>7.3f} {:>6.1f}% {}\n", row.name, row.before,
                   row.after, row.ratio, 100.0 * row.tolerance, word(row));
    }
    fmt::print("{} rows the same within their noise\n", same);
    print_hashes(*before, *after);
    return any_worse(rows) ? 1 : 0;
}

const Registration kCompare(
    {"compare", "what got slower or larger from one report to another; status 1 if anything did",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         app.add_option("before", options->before,
                        "report of vellus_bench all, engine, demo or scaling --json")
             ->required();
         app.add_option("after", options->after, "another one")->required();
         app.add_option("--least", options->tolerances.least,
                        "share that a time must change by, however little noise there is")
             ->check(CLI::Range(0.0, 10.0))
             ->capture_default_str();
         app.add_flag("--all", options->all, "print unchanged rows too");
         return [options] { return run_compare(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
