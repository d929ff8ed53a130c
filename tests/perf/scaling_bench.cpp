#include <fmt/format.h>

#include <memory>

#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "modules/hair/groom/groom_report.h"
#include "modules/hair/groom/upright.h"
#include "modules/hair/grow/grow.h"
#include "tests/perf/bench.h"
#include "tests/perf/frame_samples.h"
#include "tests/perf/hair_rig.h"

// How a frame grows with the number of strands and with the picture: the same head of grown hair
// under sun and sky.
namespace vellus::bench {

namespace {

constexpr uint32_t kPoints = 16;
constexpr uint32_t kSeed = 7;
constexpr uint32_t kFramesPerCalibration = 8;

struct Options {
    std::string device;
    std::string json;
    std::string only;
    bool quick = false;
};

struct Case {
    uint32_t strands = 0;
    glm::uvec2 size{0};
    uint32_t warm_up = 8;
    uint32_t frames = 32;
};

std::vector<Case> cases(bool quick) {
    constexpr glm::uvec2 kSmall{640, 360};
    if (quick) {
        return {{.strands = 1'000, .size = {160, 90}, .warm_up = 2, .frames = 4},
                {.strands = 10'000, .size = {160, 90}, .warm_up = 2, .frames = 4},
                {.strands = 10'000, .size = {256, 256}, .warm_up = 2, .frames = 4}};
    }
    return {{.strands = 1'000, .size = kSmall},
            {.strands = 10'000, .size = kSmall},
            {.strands = 100'000, .size = kSmall, .frames = 16},
            {.strands = 1'000'000, .size = kSmall, .warm_up = 2, .frames = 6},
            {.strands = 10'000, .size = {256, 256}},
            {.strands = 10'000, .size = {512, 512}},
            {.strands = 10'000, .size = {1280, 720}, .frames = 16},
            {.strands = 10'000, .size = {1920, 1080}, .frames = 16}};
}

std::string name_of(const Case& c) {
    return fmt::format("{} strands {}x{}", c.strands, c.size.x, c.size.y);
}

Result<hair::StrandData> grow(uint32_t strands) {
    hair::GrowSettings settings = hair::preset(hair::GrowStyle::kStraight);
    settings.count = strands;
    settings.points = kPoints;
    const auto head = hair::sphere_surface({0.0f, 1.6f, 0.0f}, 0.1f, false);
    auto groom = hair::grow_groom(head, settings, kSeed);
    if (!groom) return groom.error();
    hair::repair(*groom);
    const auto width = static_cast<float>(hair::default_width(*groom, 1.0));
    auto data = hair::prepare_strands(*groom, glm::dmat4(1.0), width);
    // A coarser level would hide what more strands cost.
    data.levels.clear();
    return data;
}

Result<FrameSamples> measure(const Case& c, const hair::StrandData& strands, const Options& options,
                             Report& report, std::vector<double>& calibrations) {
    auto rig = HairRig::create(
        {.strands = &strands, .device = options.device, .width = c.size.x, .height = c.size.y});
    if (!rig) return rig.error();
    report.device = (*rig)->device().traits().name;
    FrameSamples samples;
    for (uint32_t frame = 0; frame < c.warm_up + c.frames; ++frame) {
        if (frame % kFramesPerCalibration == 0) calibrations.push_back(run_calibration());
        const double wall = wall_seconds();
        const double cpu = process_cpu_seconds();
        if (auto drawn = (*rig)->draw(Wanted::kPicture); !drawn) return drawn.error();
        if (frame < c.warm_up) continue;
        const double wall_ms = 1e3 * (wall_seconds() - wall);
        samples.add(wall_ms, 1e3 * (process_cpu_seconds() - cpu), (*rig)->report());
    }
    return samples;
}

void print_case(const Case& c, const FrameSamples& samples) {
    const double device_ms = make_row("", "ms", samples.gpu_ms).median;
    fmt::print(
        "{:<26} {:>3} frames after {}: {:.1f} ms wall, {:.1f} ms CPU, {:.1f} ms device, {:.1f} "
        "MiB\n",
        name_of(c), c.frames, c.warm_up, make_row("", "ms", samples.wall_ms).median,
        make_row("", "ms", samples.cpu_ms).median, device_ms, samples.bytes / (1U << 20U));
    print_passes(samples, 0.01 * device_ms);
    std::fflush(stdout);
}

Result<void> run_cases(const Options& options) {
    Report report{.command =
                      options.quick ? "vellus_bench scaling --quick" : "vellus_bench scaling"};
    std::vector<double> calibrations;
    hair::StrandData strands;
    uint32_t grown = 0;
    for (const Case& c : cases(options.quick)) {
        if (name_of(c).find(options.only) == std::string::npos) continue;
        if (c.strands != grown) {
            auto made = grow(c.strands);
            if (!made) return made.error();
            strands = std::move(*made);
            grown = c.strands;
        }
        auto samples = measure(c, strands, options, report, calibrations);
        if (!samples) return samples.error();
        add_rows(report, name_of(c), *samples);
        report.rows.push_back(make_row(name_of(c) + "/gpu", "ms", samples->gpu_ms));
        print_case(c, *samples);
    }
    report.calibration = make_row("calibration", "ms", calibrations);
    print_calibration(report);
    if (options.json.empty()) return {};
    return write_file(options.json, std::string_view(to_json(report)));
}

const Registration kScaling(
    {"scaling", "a frame of hair by number of strands and by size of the picture",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         app.add_flag("--quick", options->quick, "few strands, small pictures, four frames");
         app.add_option("--only", options->only, "rows whose name has this");
         app.add_option("--device", options->device, "part of its name");
         app.add_option("--json", options->json, "file for the report; see compare");
         return [options] { return exit_status(run_cases(*options)); };
     }});

}  // namespace

}  // namespace vellus::bench
