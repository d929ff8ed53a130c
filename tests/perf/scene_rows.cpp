#include "tests/perf/scene_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "engine/platform/hash.h"
#include "engine/platform/user_folders.h"
#include "game_demo/src/content.h"
#include "game_demo/src/progress.h"
#include "game_demo/src/renderer.h"
#include "tests/perf/frame_samples.h"
#include "tests/perf/timed_work.h"

namespace vellus::bench {

namespace {

namespace fs = std::filesystem;
using demo::Output;
using demo::Renderer;

constexpr uint32_t kFramesPerCalibration = 8;

struct Samples : FrameSamples {
    uint64_t hash = 0;
};

std::vector<fs::path> scene_files(const SceneOptions& options) {
    std::vector<fs::path> files;
    for (const std::string& scene : options.scenes) {
        const fs::path known = demo::scene_folder() / (scene + ".gltf");
        files.push_back(fs::exists(known) ? known : fs::path(scene));
    }
    if (!files.empty()) return files;
    for (const auto& entry : fs::directory_iterator(demo::scene_folder())) {
        if (entry.path().extension() == ".gltf") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

Result<Samples> measure(gpu::Device& device, const fs::path& scene, const SceneOptions& options,
                        std::vector<double>& calibrations) {
    auto renderer = Renderer::create(device, {});
    if (!renderer) return renderer.error();
    demo::Options content;
    content.scene = scene;
    content.size = {options.size[0], options.size[1]};
    if (auto loaded = demo::load_content(**renderer, content); !loaded) return loaded.error();
    Samples samples;
    demo::Progress progress(options.warm_up + options.frames);
    for (uint32_t frame = 0; frame < options.warm_up + options.frames; ++frame) {
        if (frame % kFramesPerCalibration == 0) calibrations.push_back(run_calibration());
        const double wall = wall_seconds();
        const double cpu = process_cpu_seconds();
        keep_busy(options.inject_ms);
        const bool last = frame + 1 == options.warm_up + options.frames;
        auto drawn = (*renderer)->draw(last ? Output::kPixels : Output::kNowhere);
        if (!drawn) return drawn.error();
        if (auto done = (*renderer)->wait(); !done) return done.error();
        progress.update(frame + 1);
        if (frame < options.warm_up) continue;
        const double wall_ms = 1e3 * (wall_seconds() - wall);
        samples.add(wall_ms, 1e3 * (process_cpu_seconds() - cpu), (*renderer)->report());
    }
    const asset::Image picture = (*renderer)->pixels();
    samples.hash = fnv1a(std::as_bytes(std::span(picture.rgba)));
    return samples;
}

Result<void> write_csv(const fs::path& folder, const std::string& scene, const Samples& samples) {
    std::string text = "frame,wall_ms,cpu_ms";
    for (const auto& [name, times] : samples.passes) text.append(",").append(name);
    text += "\n";
    for (size_t frame = 0; frame < samples.wall_ms.size(); ++frame) {
        text +=
            fmt::format("{},{:.3f},{:.3f}", frame, samples.wall_ms[frame], samples.cpu_ms[frame]);
        for (const auto& [name, times] : samples.passes)
            text += fmt::format(",{:.3f}", times[frame]);
        text += "\n";
    }
    return write_file(folder / (scene + ".csv"), text);
}

void print_scene(const std::string& scene, const Samples& samples) {
    const Row wall = make_row("", "ms", samples.wall_ms);
    const Row cpu = make_row("", "ms", samples.cpu_ms);
    fmt::print(
        "{:<10} {:>6.1f} frames a second: {:.1f} ms wall (p95 {:.1f}), {:.1f} ms CPU, hash "
        "{:016x}\n",
        scene, wall.median > 0.0 ? 1e3 / wall.median : 0.0, wall.median, wall.p95, cpu.median,
        samples.hash);
    print_passes(samples, 0.05);
}

}  // namespace

Result<void> measure_scenes(const SceneOptions& options, Report& report,
                            std::vector<double>& calibrations) {
    auto device =
        gpu::Device::create({.name = options.device, .pipeline_cache_folder = cache_folder()});
    if (!device) return device.error();
    report.device = (*device)->traits().name;
    fmt::print("{}x{}, {} frames after {}, on {}\n", options.size[0], options.size[1],
               options.frames, options.warm_up, report.device);
    for (const fs::path& file : scene_files(options)) {
        const std::string scene = file.stem().string();
        auto samples = measure(**device, file, options, calibrations);
        if (!samples) return samples.error();
        add_rows(report, scene, *samples);
        report.hashes[scene] = fmt::format("{:016x}", samples->hash);
        print_scene(scene, *samples);
        if (options.csv.empty()) continue;
        if (auto saved = write_csv(options.csv, scene, *samples); !saved) return saved;
    }
    return {};
}

}  // namespace vellus::bench
