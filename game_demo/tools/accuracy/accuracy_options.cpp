#include "game_demo/tools/accuracy/accuracy_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <charconv>
#include <ostream>

#include "game_demo/src/option_values.h"
#include "game_demo/tools/accuracy/jobs.h"

namespace vellus::demo {

namespace {

std::vector<std::string> strings(std::span<const std::string_view> names) {
    return {names.begin(), names.end()};
}

void add_list(CLI::App& app, const char* name, std::vector<std::string>& slot,
              const std::vector<std::string>& legal, const char* help) {
    auto* option = app.add_option(name, slot, help)->delimiter(',')->type_name("NAME,...");
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(false);
    if (!legal.empty()) option->check(CLI::IsMember(legal));
}

void add_choice_options(CLI::App& app, AccuracyOptions& options) {
    app.add_flag(
        "--quick", options.quick,
        "A small run of a few minutes: fewer grooms, colours, lights and settings, smaller "
        "pictures");
    add_list(app, "--axes", options.axes, measured_axes(), "Only these axes");
    add_list(app, "--grooms", options.grooms, strings(kGrooms), "Only these grooms");
    add_list(app, "--colours", options.colours, strings(kColours), "Only these hair colours");
    add_list(app, "--lights", options.lights, strings(kLights), "Only light from there");
    add_list(app, "--techniques", options.techniques, {},
             "Only these techniques, on every axis (base and AXIS=TECHNIQUE on axis frame)");
    app.add_flag("--list", options.list, "Print the jobs and end");
    app.add_option_function<std::string>(
           "--shard",
           [&](const std::string& text) {
               const auto shard = read_shard(text);
               if (!shard) {
                   throw CLI::ValidationError("--shard",
                                              "'" + text + "' is not I/N with I below N");
               }
               options.shard = *shard;
           },
           "Only part I of N of the jobs, counted from 0; --merge joins the parts")
        ->type_name("I/N");
}

void add_size_options(CLI::App& app, AccuracyOptions& options) {
    AccuracyOptions quick;
    quick.quick = true;
    const JobSizes all = job_sizes({});
    const JobSizes few = job_sizes(quick);
    const auto number = [&](const char* name, uint32_t& slot, uint32_t high, const char* help,
                            uint32_t JobSizes::*size) {
        app.add_option(name, slot, fmt::format("{} ({}; quick: {})", help, all.*size, few.*size))
            ->check(CLI::Range(1u, high))
            ->type_name("N");
    };
    number("--size", options.size, 2048, "Pixels along a picture's side", &JobSizes::size);
    number("--frames", options.frames, 1024, "Frames that count", &JobSizes::frames);
    number("--warmup", options.warm_up, 1024,
           "Frames for TAA to settle in, where opacity is measured", &JobSizes::warm_up);
    number("--spp", options.samples, 65536, "Path tracer's samples a pixel", &JobSizes::samples);
    number("--strands", options.strands, 100'000, "Strands of each groom", &JobSizes::strands);
    app.add_option("--seed", options.seed, "Seed of grooms and references")
        ->type_name("S")
        ->capture_default_str();
}

}  // namespace

std::optional<Shard> read_shard(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.index);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') return std::nullopt;
    const auto second = std::from_chars(first.ptr + 1, end, shard.count);
    if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
    if (shard.index >= shard.count) return std::nullopt;
    return shard;
}

ParsedAccuracyOptions parse_accuracy_options(int argc, const char* const* argv, std::ostream& out,
                                             std::ostream& err) {
    ParsedAccuracyOptions parsed;
    AccuracyOptions& options = parsed.options;
    CLI::App app(
        "Measures every technique's error against its reference, its time and its memory; writes "
        "OUT/accuracy.csv, accuracy.json and accuracy.html.",
        "vellus_accuracy");
    app.footer(
        "Ctrl-C keeps what is done; the same command goes on from there. For a cluster: "
        "vellus_accuracy --shard $SLURM_ARRAY_TASK_ID/16 --out part$SLURM_ARRAY_TASK_ID in each "
        "task, then vellus_accuracy --merge part* --out all.");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("--out", options.out, "Folder for results; what is done there is not done again")
        ->type_name("DIR")
        ->capture_default_str();
    add_choice_options(app, options);
    add_size_options(app, options);
    app.add_option("--device", options.device, "Part of the GPU's name")->type_name("NAME");
    app.add_option("--merge", options.merge,
                   "Measure nothing: join the results of these folders into that of --out")
        ->type_name("DIR...")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--budget", options.budget_ms,
                   "Then name, for each groom and colour, the combination of techniques with the "
                   "least error that a frame of MS milliseconds has time for, and measure it")
        ->check(CLI::PositiveNumber)
        ->type_name("MS");
    parsed.exit_status = parse_or_tell(
        app, argc, argv, [] {}, out, err);
    options.command = "vellus_accuracy";
    for (int i = 1; i < argc; ++i) options.command.append(" ").append(argv[i]);
    return parsed;
}

}  // namespace vellus::demo
