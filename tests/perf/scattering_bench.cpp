#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/gpu/command_buffer.h"
#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "modules/hair/scattering/fibre_library.h"
#include "tests/perf/bench.h"
#include "tests/perf/hair_rig.h"
#include "tests/perf/report/report.h"
#include "tests/support/sampling.h"
#include "tests/support/scattering_error.h"

// Every technique of the scattering axis: how far its lobes are from d'Eon's, and what they cost.
namespace vellus::bench {

namespace {

constexpr uint32_t kTechniques = hair::kScatteringTechniques;

struct Options {
    HairRigOptions rig;
    std::string json;
    int steps = 90;
    int rounds = 16;
    bool frames = true;
};

/// One row of the table; ratios are to karis.
struct Row {
    double l1 = 0.0;
    double worst_l1 = 0.0;
    double furnace_least = 1e9;
    double furnace_most = 0.0;
    std::vector<double> host_ns;
    std::vector<double> device_ns;
    std::vector<double> shade_ms;
};

/// Push constants of shaders/perf/scattering.comp.glsl.
struct Push {
    VkDeviceAddress sums;
    uint32_t count;
    uint32_t lights;
    glm::vec3 color;
    float roughness;
    float shift;
    uint32_t padding = 0;
};

constexpr uint32_t kThreads = 1U << 17;
constexpr uint32_t kLights = 16;

std::string_view name_of(uint32_t technique) {
    return hair::technique_ids("scattering")[technique];
}

hair::glsl::HairSurface surface(float color, float roughness, float shift) {
    return {glm::vec3(color), 0.5f, roughness, 1.0f, shift};
}

void measure_errors(std::vector<Row>& rows, int steps) {
    int grids = 0;
    for (const float shift : {0.0f, 0.035f}) {
        for (const float roughness : {0.2f, 0.3f, 0.5f, 0.8f, 1.0f}) {
            for (const float color : {0.02f, 0.2f, 0.5f, 0.9f, 1.0f}) {
                const test::DeonGrid grid(surface(color, roughness, shift), {}, steps, 24);
                ++grids;
                for (uint32_t t = 0; t < kTechniques; ++t) {
                    const auto error = grid.error(static_cast<int>(t));
                    Row& row = rows[t];
                    row.l1 += error.l1;
                    row.worst_l1 = std::max(row.worst_l1, error.l1);
                    if (color < 1.0f) continue;
                    row.furnace_least = std::min(row.furnace_least, error.furnace_least);
                    row.furnace_most = std::max(row.furnace_most, error.furnace_most);
                }
            }
        }
    }
    for (Row& row : rows) row.l1 /= grids;
}

hair::glsl::HairFibre standard_fibre() {
    hair::glsl::HairFibre fibre{};
    hair::fit_azimuthal({}, fibre);
    hair::set_longitudinal(0.3f, 0.035f, fibre);
    return fibre;
}

/// The shader's functions as C++, one evaluation after the other on one core.
double host_cost(uint32_t technique, const std::vector<glm::vec3>& directions) {
    const auto fibre = standard_fibre();
    const auto s = surface(0.4f, 0.3f, 0.035f);
    const double start = process_cpu_seconds();
    float sum = 0.0f;
    for (size_t i = 0; i + 1 < directions.size(); ++i) {
        const auto frame = hair::glsl::hair_frame({1, 0, 0}, directions[i]);
        const auto eye = hair::glsl::hair_eye(fibre, frame);
        sum += hair::glsl::hair_bsdf(static_cast<int>(technique), fibre, s, frame, eye,
                                     directions[i + 1])
                   .x;
    }
    volatile float kept = sum;
    static_cast<void>(kept);
    return (process_cpu_seconds() - start) * 1e9 / static_cast<double>(directions.size() - 1);
}

Result<double> device_cost(gpu::Device& device, uint32_t technique, const gpu::Buffer& sums,
                           const gpu::Buffer& fibre) {
    auto pipeline = device.pipelines().compute({.shader = "perf/scattering.comp.glsl",
                                                .bindings = {gpu::Binding::kUniform},
                                                .push_bytes = sizeof(Push),
                                                .constants = {technique}});
    if (!pipeline) return pipeline.error();
    const Push push{.sums = sums.address(),
                    .count = kThreads,
                    .lights = kLights,
                    .color = glm::vec3(0.4f),
                    .roughness = 0.3f,
                    .shift = 0.035f};
    const bool is_cpu = device.traits().is_cpu;
    const double start = is_cpu ? process_cpu_seconds() : wall_seconds();
    auto done = device.submit_now("scattering", [&](VkCommandBuffer handle) {
        gpu::CommandBuffer commands(handle);
        commands.bind(**pipeline);
        commands.images({}, {{fibre.handle(), 0, sizeof(hair::glsl::HairFibre)}});
        commands.push(push);
        commands.dispatch_threads(kThreads, 64);
    });
    if (!done) return done.error();
    return ((is_cpu ? process_cpu_seconds() : wall_seconds()) - start) * 1e9 /
           (static_cast<double>(kThreads) * kLights);
}

Result<void> measure_costs(gpu::Device& device, std::vector<Row>& rows, int rounds) {
    auto sums = gpu::Buffer::create(device, kThreads * 4, gpu::MemoryKind::kDevice, "sums");
    if (!sums) return sums.error();
    const auto standard = standard_fibre();
    auto fibre = gpu::Buffer::upload_span(device, std::span(&standard, 1), "fibre");
    if (!fibre) return fibre.error();
    std::vector<glm::vec3> directions;
    for (uint64_t i = 0; i < 20'000; ++i) directions.emplace_back(test::Random(9, i).direction());
    // Round robin, so that a busy moment hits all alike; the first round warms up.
    for (int round = 0; round <= rounds; ++round) {
        for (uint32_t t = 0; t < kTechniques; ++t) {
            auto cost = device_cost(device, t, *sums, *fibre);
            if (!cost) return cost.error();
            if (round == 0) continue;
            rows[t].device_ns.push_back(*cost);
            rows[t].host_ns.push_back(host_cost(t, directions));
        }
    }
    return {};
}

/// Whole frames, round robin: each technique with the fake normal, then series_b with each
/// technique of multiple scattering.
Result<void> measure_frames(const Options& options, std::vector<Row>& rows,
                            std::vector<std::vector<double>>& multiple) {
    std::vector<std::unique_ptr<HairRig>> rigs;
    const size_t multiples = hair::technique_ids("multiple").size();
    multiple.resize(multiples);
    for (size_t i = 0; i < kTechniques + multiples; ++i) {
        HairRigOptions rig = options.rig;
        rig.techniques.scattering = i < kTechniques ? static_cast<hair::ScatteringTechnique>(i)
                                                    : hair::ScatteringTechnique::kSeriesB;
        if (i >= kTechniques) {
            rig.techniques.multiple = static_cast<hair::MultipleTechnique>(i - kTechniques);
        }
        auto made = HairRig::create(rig);
        if (!made) return made.error();
        rigs.push_back(std::move(*made));
    }
    for (int round = 0; round < options.rounds + 2; ++round) {
        for (size_t i = 0; i < rigs.size(); ++i) {
            if (auto drawn = rigs[i]->draw(Wanted::kPicture); !drawn) return drawn;
            if (round < 2) continue;
            auto& times = i < kTechniques ? rows[i].shade_ms : multiple[i - kTechniques];
            for (const graph::PassReport& pass : rigs[i]->report().passes) {
                if (pass.name == "hair/shade") times.push_back(pass.gpu_ms);
            }
        }
    }
    return {};
}

nlohmann::json to_json(uint32_t technique, const Row& row) {
    return {{"technique", name_of(technique)}, {"l1", row.l1},
            {"worst_l1", row.worst_l1},        {"furnace", {row.furnace_least, row.furnace_most}},
            {"host_ns", row.host_ns},          {"device_ns", row.device_ns},
            {"shade_ms", row.shade_ms}};
}

void print_rows(const std::vector<Row>& rows) {
    fmt::print("{:<16} {:>8} {:>8} {:>15} {:>9} {:>10} {:>6} {:>9} {:>6}\n", "technique", "L1",
               "worst", "furnace/d'Eon", "CPU ns", "device ns", "ratio", "shade ms", "ratio");
    const double device = median(rows[0].device_ns);
    const double shade = median(rows[0].shade_ms);
    for (uint32_t t = 0; t < kTechniques; ++t) {
        const Row& row = rows[t];
        fmt::print("{:<16} {:>7.2f}% {:>7.2f}% {:>6.3f} - {:>6.3f} {:>9.1f} {:>10.2f} {:>6.2f}",
                   name_of(t), 100.0 * row.l1, 100.0 * row.worst_l1, row.furnace_least,
                   row.furnace_most, median(row.host_ns), median(row.device_ns),
                   median(row.device_ns) / device);
        if (shade > 0.0) {
            fmt::print(" {:>9.2f} {:>6.2f}", median(row.shade_ms), median(row.shade_ms) / shade);
        }
        fmt::print("\n");
    }
}

int run_scattering(const Options& options) {
    std::vector<Row> rows(kTechniques);
    std::vector<std::vector<double>> multiple;
    measure_errors(rows, options.steps);
    auto device = gpu::Device::create({.name = options.rig.device});
    Result<void> done;
    if (!device) {
        done = device.error();
    } else {
        done = measure_costs(**device, rows, options.rounds);
    }
    if (done && options.frames) done = measure_frames(options, rows, multiple);
    if (!done) {
        fmt::print(stderr, "error: {}\n", done.error().message());
        return 1;
    }
    fmt::print(
        "{}: lobes against d'Eon 2011, energy-weighted L1 over {} inclinations each way and "
        "24 azimuths, mean of 50 fibres (roughness 0.2-1, C 0.02-1, shift 0 and 0.035); "
        "medians of {} rounds\n",
        (*device)->traits().name, options.steps, options.rounds);
    print_rows(rows);
    for (size_t i = 0; i < multiple.size(); ++i) {
        fmt::print("series_b, multiple={:<12} {:>9.2f} ms shade\n",
                   hair::technique_ids("multiple")[i], median(multiple[i]));
    }
    if (options.json.empty()) return 0;
    nlohmann::json json = nlohmann::json::array();
    for (uint32_t t = 0; t < kTechniques; ++t) json.push_back(to_json(t, rows[t]));
    auto written = write_file(options.json, std::string_view(json.dump(2)));
    if (!written) fmt::print(stderr, "error: {}\n", written.error().message());
    return written ? 0 : 1;
}

const Registration kScattering(
    {"scattering", "error and cost of every technique of the scattering axis",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         options->rig.width = 640;
         options->rig.height = 360;
         app.add_option("--groom", options->rig.groom, "groom file");
         app.add_option("--device", options->rig.device, "part of its name");
         app.add_option("--width", options->rig.width, "pixels")->check(CLI::Range(1, 16384));
         app.add_option("--height", options->rig.height, "pixels")->check(CLI::Range(1, 16384));
         app.add_option("--steps", options->steps, "inclinations of the error's grid")
             ->check(CLI::Range(8, 1000));
         app.add_option("--rounds", options->rounds, "of each measurement")
             ->check(CLI::Range(1, 10000));
         app.add_flag("!--no-frames", options->frames, "leave whole frames out");
         app.add_option("--json", options->json, "file for the figures");
         return [options] { return run_scattering(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
