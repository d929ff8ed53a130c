#include "game_demo/src/headless.h"

#include <unistd.h>

#include "engine/asset/image_io.h"
#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "engine/platform/hash.h"
#include "engine/platform/log.h"
#include "game_demo/src/accuracy/spend_budget.h"
#include "game_demo/src/content.h"
#include "game_demo/src/explain.h"
#include "game_demo/src/progress.h"

namespace vellus::demo {

namespace {

namespace fs = std::filesystem;

/// Makes the folder, or says before anything is drawn why nothing could be written there.
Result<void> prepare_folder(const fs::path& folder) {
    std::error_code code;
    fs::create_directories(folder, code);
    if (!fs::is_directory(folder, code) || ::access(folder.c_str(), W_OK) != 0) {
        return Error{"cannot write there", folder.string(), "give another folder with --out"};
    }
    // Figures of an earlier run must not be taken for this one's if it fails.
    fs::remove(folder / "stats.json", code);
    return {};
}

Result<FrameStats> draw_measured(Renderer& renderer, Output output) {
    const double cpu = process_cpu_seconds();
    const double wall = wall_seconds();
    if (auto drawn = renderer.draw(output); !drawn) return drawn.error();
    if (auto done = renderer.wait(); !done) return done.error();
    FrameStats stats;
    stats.cpu_ms = 1e3 * (process_cpu_seconds() - cpu);
    stats.wall_ms = 1e3 * (wall_seconds() - wall);
    stats.report = renderer.report();
    stats.effects = renderer.effects();
    return stats;
}

Result<RunStats> draw_frames(Renderer& renderer, const Options& options) {
    RunStats run;
    run.scene = content_path(options).string();
    run.seed = options.seed;
    run.size = options.size;
    Progress progress(options.warmup + options.frames);
    for (uint32_t index = 0; index < options.warmup; ++index) {
        auto drawn = draw_measured(renderer, Output::kNowhere);
        if (!drawn) return drawn.error();
        progress.update(index + 1);
    }
    for (uint32_t index = 0; index < options.frames; ++index) {
        const bool last = index + 1 == options.frames;
        const bool kept = options.save.keeps(index, options.frames);
        auto frame = draw_measured(renderer, kept || last ? Output::kPixels : Output::kNowhere);
        if (!frame) return frame.error();
        frame->index = index;
        run.frames.push_back(std::move(*frame));
        if (kept || last) {
            const asset::Image image = renderer.pixels();
            run.hash = fnv1a(std::as_bytes(std::span(image.rgba)));
            if (kept) {
                const auto file = options.out / fmt::format("frame_{:04}.png", index);
                if (auto saved = asset::save_png(file, image); !saved) return saved.error();
            }
        }
        progress.update(options.warmup + index + 1);
    }
    return run;
}

/// Frames that tell what one takes, before the first that counts.
Result<void> keep_to_budget(Renderer& renderer, const Options& options) {
    auto table = load_accuracy_or_default(options.accuracy);
    if (!table) return table.error();
    for (FrameWatch watch; !watch.done();) {
        auto frame = draw_measured(renderer, Output::kNowhere);
        if (!frame) return frame.error();
        const auto share = watch.add(frame->report);
        if (!share) continue;
        return spend_budget(renderer.world(), *table, *share, *options.budget_ms);
    }
    return {};
}

}  // namespace

Result<void> run_headless(gpu::Device& device, const Options& options) {
    if (auto ready = prepare_folder(options.out); !ready) return ready;
    auto renderer = Renderer::create(device, options.switches);
    if (!renderer) return renderer.error();
    if (auto loaded = load_content(**renderer, options); !loaded) return loaded.error();
    if (options.budget_ms) {
        if (auto kept = keep_to_budget(**renderer, options); !kept) return kept;
    }
    auto run = draw_frames(**renderer, options);
    if (!run) return run.error();
    run->device = device.traits();
    if (options.explain) print_explanation(**renderer);
    auto written = write_file(options.out / "stats.json", to_json(*run));
    if (written) log_info("pictures and stats.json are in {}", options.out.string());
    return written;
}

}  // namespace vellus::demo
