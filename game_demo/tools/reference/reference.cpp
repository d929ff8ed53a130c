#include "game_demo/tools/reference/reference.h"

#include <unistd.h>

#include <csignal>

#include "engine/asset/image_io.h"
#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "engine/platform/hash.h"
#include "engine/platform/log.h"
#include "game_demo/src/content.h"
#include "game_demo/src/progress.h"
#include "game_demo/tools/reference/gather_scene.h"
#include "modules/hair/reference/tracer/render.h"
#include "modules/scene/view.h"

namespace vellus::demo {

namespace {

namespace fs = std::filesystem;
namespace tracer = hair::tracer;

constexpr uint64_t kVersion = 2;  // of the sums: raise it where the same options give others
constexpr double kSaveSeconds = 60.0;
constexpr int kInterrupted = 130;

std::atomic<bool> stop_wished = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void wish_stop(int) {
    stop_wished = true;
}

fs::path checkpoint_path(const ReferenceOptions& options) {
    fs::path path = options.out;
    path += ".checkpoint";
    return path;
}

/// Says before anything is traced why a picture could not be written.
Result<void> prepare_folder(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code code;
    fs::create_directories(folder, code);
    if (!fs::is_directory(folder, code) || ::access(folder.c_str(), W_OK) != 0) {
        return Error{"cannot write there", folder.string(), "give another file with --out"};
    }
    return {};
}

uint64_t fingerprint_of(const tracer::Scene& scene, const ReferenceOptions& options) {
    const std::array<uint64_t, 6> all = {tracer::hash(scene),     options.content.size[0],
                                         options.content.size[1], options.content.seed,
                                         options.depth,           kVersion};
    return fnv1a(std::as_bytes(std::span(all)));
}

Result<tracer::Film> open_film(const ReferenceOptions& options, uint64_t fingerprint) {
    const fs::path path = checkpoint_path(options);
    std::error_code code;
    if (!fs::exists(path, code)) {
        return tracer::Film({options.content.size[0], options.content.size[1]});
    }
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    auto film = tracer::Film::from_checkpoint(*bytes, fingerprint);
    if (!film) return Error{film.error().what, path.string(), film.error().remedy};
    log_info("going on from {}: {} samples per pixel are there", path.string(), film->complete());
    return film;
}

Result<void> save_pictures(const ReferenceOptions& options, const tracer::Film& film,
                           float exposure) {
    if (auto saved = asset::save_planes(options.out, film.planes()); !saved) return saved;
    if (options.png.empty()) return {};
    return asset::save_png(options.png, film.display(exposure));
}

Result<void> save_checkpoint(const ReferenceOptions& options, const tracer::Film& film,
                             uint64_t fingerprint) {
    const auto bytes = film.checkpoint(fingerprint);
    return write_file(checkpoint_path(options), std::span<const std::byte>(bytes));
}

/// Adds one sample to every pixel at a time, so that progress shows and little is lost.
Result<void> add_all_samples(const tracer::PathTracer& path_tracer, const ReferenceOptions& options,
                             uint64_t fingerprint, tracer::Film& film) {
    const uint32_t first = film.complete();
    Progress progress(options.samples, "samples", first);
    double saved_at = wall_seconds();
    for (uint32_t done = first; done < options.samples && !stop_wished;) {
        tracer::add_samples(path_tracer, options.content.seed, done + 1, film, stop_wished);
        if (stop_wished) break;
        progress.update(++done);
        if (wall_seconds() - saved_at < kSaveSeconds) continue;
        if (auto saved = save_checkpoint(options, film, fingerprint); !saved) return saved;
        saved_at = wall_seconds();
    }
    return {};
}

Result<void> trace(const ReferenceOptions& options) {
    if (auto ready = prepare_folder(options.out); !ready) return ready;
    auto loaded = load_reference(options);
    if (!loaded) return loaded.error();
    const uint64_t fingerprint = fingerprint_of(loaded->scene, options);
    auto film = open_film(options, fingerprint);
    if (!film) return film.error();
    auto path_tracer =
        tracer::PathTracer::create(std::move(loaded->scene), {.max_depth = options.depth});
    if (!path_tracer) return path_tracer.error();
    if (auto added = add_all_samples(**path_tracer, options, fingerprint, *film); !added) {
        return added;
    }
    if (auto saved = save_pictures(options, *film, loaded->exposure); !saved) return saved;
    if (stop_wished) {
        log_info("stopped: {} has {} of {} samples per pixel; the same command goes on",
                 options.out.string(), film->complete(), options.samples);
        return save_checkpoint(options, *film, fingerprint);
    }
    std::error_code code;
    fs::remove(checkpoint_path(options), code);
    log_info("{} has {} samples per pixel", options.out.string(), film->complete());
    return {};
}

}  // namespace

Result<ReferenceScene> load_reference(const ReferenceOptions& options) {
    auto host = CpuHost::create();
    if (!host) return host.error();
    if (auto loaded = load_content(**host, options.content); !loaded) return loaded.error();
    (*host)->run_to_frame(options.frame);
    return ReferenceScene{gather_scene(**host),
                          (*host)->world().resource<scene::ViewSettings>().exposure};
}

int run_reference(const ReferenceOptions& options) {
    std::signal(SIGINT, wish_stop);
    std::signal(SIGTERM, wish_stop);
    const auto traced = trace(options);
    if (!traced) {
        log_error("{}", traced.error().message());
        return 1;
    }
    return stop_wished ? kInterrupted : 0;
}

}  // namespace vellus::demo
