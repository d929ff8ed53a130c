#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "tests/perf/allocation_count.h"
#include "tests/perf/bench.h"
#include "tests/perf/hair_rig.h"
#include "tests/perf/report/report.h"

// What a whole frame of hair costs, pass by pass, beside the cheapest frame there is: the closest
// visible segment of each pixel and nothing else.
namespace vellus::bench {

namespace {

struct Options {
    HairRigOptions rig;
    std::string json;
    int frames = 64;
    int warm_up = 8;
};

struct Cost {
    std::vector<double> cpu_ms;
    std::vector<double> wall_ms;
    std::map<std::string, std::vector<double>> passes;
    uint64_t allocations = 0;
    uint64_t objects = 0;
};

Result<Cost> measure(HairRig& rig, Wanted wanted, const Options& options) {
    Cost cost;
    for (int frame = 0; frame < options.warm_up; ++frame) {
        if (auto drawn = rig.draw(wanted); !drawn) return drawn.error();
    }
    const uint64_t objects = rig.objects_created();
    for (int frame = 0; frame < options.frames; ++frame) {
        const double wall = wall_seconds();
        const double cpu = process_cpu_seconds();
        const uint64_t allocated = allocations();
        if (auto drawn = rig.draw(wanted); !drawn) return drawn.error();
        cost.allocations += allocations() - allocated;
        cost.cpu_ms.push_back((process_cpu_seconds() - cpu) * 1e3);
        cost.wall_ms.push_back((wall_seconds() - wall) * 1e3);
        for (const graph::PassReport& pass : rig.report().passes) {
            cost.passes[pass.name].push_back(pass.gpu_ms);
        }
    }
    cost.objects = rig.objects_created() - objects;
    return cost;
}

void print(const char* title, const Cost& cost, double target) {
    fmt::print("{:<28} {:>8.1f} ms CPU, {:>7.1f} ms wall", title, median(cost.cpu_ms),
               median(cost.wall_ms));
    if (target > 0.0) {
        fmt::print("   target {:.0f} ms: {}", target,
                   median(cost.cpu_ms) <= target ? "met" : "missed");
    }
    fmt::print("\n  {} allocations and {} device objects in all counted frames\n", cost.allocations,
               cost.objects);
    for (const auto& [name, times] : cost.passes) {
        fmt::print("  {:<26} {:>8.2f} ms\n", name, median(times));
    }
}

int run_hair(const Options& options) {
    auto rig = HairRig::create(options.rig);
    if (!rig) {
        fmt::print(stderr, "error: {}\n", rig.error().message());
        return 1;
    }
    auto cheapest = measure(**rig, Wanted::kClosestSegment, options);
    const auto hits = (*rig)->values();
    auto full = measure(**rig, Wanted::kPicture, options);
    for (const auto* result : {&cheapest, &full}) {
        if (*result) continue;
        fmt::print(stderr, "error: {}\n", result->error().message());
        return 1;
    }
    const double covered = std::accumulate(hits.begin(), hits.end(), 0.0);
    fmt::print("{} at {}x{} on {}: median of {} frames, {:.0f} pixels show hair\n",
               options.rig.groom, options.rig.width, options.rig.height,
               (*rig)->device().traits().name, options.frames, covered);
    fmt::print("pass times are {} time\n", (*rig)->device().traits().is_cpu ? "CPU wall" : "GPU");
    print("closest segment only", *cheapest, 0.0);
    print("whole frame", *full, 600.0);
    fmt::print("whole frame / closest segment: {:.2f}\n",
               median(full->cpu_ms) / median(cheapest->cpu_ms));
    if (options.json.empty()) return 0;
    const nlohmann::json json = {{"groom", options.rig.groom},
                                 {"size", {options.rig.width, options.rig.height}},
                                 {"device", (*rig)->device().traits().name},
                                 {"covered_pixels", covered},
                                 {"closest_cpu_ms", cheapest->cpu_ms},
                                 {"frame_cpu_ms", full->cpu_ms},
                                 {"passes", full->passes},
                                 {"allocations", full->allocations},
                                 {"objects", full->objects}};
    auto written = write_file(options.json, std::string_view(json.dump(2)));
    if (!written) fmt::print(stderr, "error: {}\n", written.error().message());
    return written ? 0 : 1;
}

const Registration kHair(
    {"hair", "a whole frame of hair beside the closest segment alone",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         app.add_option("--groom", options->rig.groom, "groom file");
         app.add_option("--device", options->rig.device, "part of its name");
         app.add_flag("--bound", options->rig.bound, "roots on a mesh that moves");
         app.add_option("--width", options->rig.width, "pixels")->check(CLI::Range(1, 16384));
         app.add_option("--height", options->rig.height, "pixels")->check(CLI::Range(1, 16384));
         app.add_option("--frames", options->frames, "counted frames")
             ->check(CLI::Range(1, 100000));
         app.add_option("--json", options->json, "file for the figures");
         return [options] { return run_hair(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
