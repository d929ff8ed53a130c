#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <map>
#include <memory>

#include "engine/asset/image_io.h"
#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "engine/platform/hash.h"
#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "game_demo/tools/reference/reference.h"
#include "modules/display/readback.h"
#include "modules/hair/components.h"
#include "modules/hair/reference/tracer/render.h"
#include "modules/light/light_set.h"
#include "tests/perf/bench.h"
#include "tests/perf/report/report.h"
#include "tests/perf/truth_scenes.h"

// Real-time hair beside the path tracer's: grooms, colours and lights, and how far the colours are
// off.
namespace vellus::bench {

namespace {

namespace fs = std::filesystem;
namespace tracer = hair::tracer;
using Pixels = std::vector<glm::dvec3>;

struct Options {
    std::string folder = "out/truth";
    std::string device;
    std::vector<std::string> only;  ///< words that a case's name must hold, all of them
    std::vector<std::string> with;  ///< "axis=id,axis=id": a column each
    std::string set;                ///< the same for all columns and for the path tracer too
    uint32_t size = 96;
    uint32_t samples = 48;
    uint32_t frames = 16;
    bool pictures = false;
};

struct Truth {
    Pixels radiance;
    std::vector<float> hair;
    double noise = 0.0;  ///< standard error of the mean over hair, relative
};

/// How far one technique is from the truth of one case, over pixels full of hair.
struct Deviation {
    glm::dvec3 mean{0.0};  ///< mean colour over the reference's, less 1
    double blocks = 0.0;   ///< mean |difference| of 8 × 8 pixels' means over the reference's mean
    double hair_ms = 0.0;  ///< of the passes hair/*

    [[nodiscard]] double colour() const {
        return (std::abs(mean.r) + std::abs(mean.g) + std::abs(mean.b)) / 3.0;
    }
};

constexpr double kFullOfHair = 0.99;

std::vector<std::string> split(const std::string& text, char by) {
    std::vector<std::string> parts;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find(by, at), text.size());
        if (end > at) parts.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

Result<std::vector<demo::TechniqueChoice>> parse_choices(const std::string& text) {
    std::vector<demo::TechniqueChoice> choices;
    for (const std::string& part : split(text, ',')) {
        const auto pair = split(part, '=');
        if (pair.size() != 2) {
            return Error{"not AXIS=TECHNIQUE", part, "write scattering=karis,multiple=none"};
        }
        hair::HairTechniques probe;
        if (auto set = hair::set_technique(probe, pair[0], pair[1]); !set) return set.error();
        choices.push_back({pair[0], pair[1]});
    }
    return choices;
}

demo::Options content_of(const fs::path& scene, const Options& options) {
    demo::Options content;
    content.scene = scene;
    content.size = {options.size, options.size};
    content.no_taa = true;
    return content;
}

Truth truth_of(const asset::PlaneImage& planes) {
    Truth truth;
    const char* const names[] = {"R", "G", "B", "error.R", "error.G", "error.B"};
    const auto at = [&](int i, size_t pixel) {
        return static_cast<double>(planes.find(names[i])->values[pixel]);
    };
    truth.hair = planes.find("hair")->values;
    glm::dvec3 sum(0.0);
    glm::dvec3 squares(0.0);
    for (size_t i = 0; i < truth.hair.size(); ++i) {
        truth.radiance.emplace_back(at(0, i), at(1, i), at(2, i));
        if (truth.hair[i] < kFullOfHair) continue;
        sum += truth.radiance.back();
        for (int c = 0; c < 3; ++c) squares[c] += at(3 + c, i) * at(3 + c, i);
    }
    for (int c = 0; c < 3; ++c) truth.noise = std::max(truth.noise, std::sqrt(squares[c]) / sum[c]);
    return truth;
}

/// Traced once: the folder keeps it under a name that tells scenes and options apart.
Result<Truth> trace(const fs::path& scene, const Options& options,
                    const std::vector<demo::TechniqueChoice>& choices) {
    demo::ReferenceOptions wanted{.content = content_of(scene, options)};
    wanted.content.techniques = choices;
    auto loaded = demo::load_reference(wanted);
    if (!loaded) return loaded.error();
    const std::array<uint64_t, 3> key = {tracer::hash(loaded->scene), options.size,
                                         options.samples};
    const fs::path kept = scene.parent_path() / fmt::format("{}_{:016x}.exr", scene.stem().string(),
                                                            fnv1a(std::as_bytes(std::span(key))));
    if (!fs::exists(kept)) {
        auto path_tracer = tracer::PathTracer::create(std::move(loaded->scene), {});
        if (!path_tracer) return path_tracer.error();
        tracer::Film film({options.size, options.size});
        const std::atomic<bool> stop = false;
        tracer::add_samples(**path_tracer, 1, options.samples, film, stop);
        if (auto saved = asset::save_planes(kept, film.planes()); !saved) return saved.error();
    }
    auto planes = asset::load_planes(kept);
    if (!planes) return planes.error();
    return truth_of(*planes);
}

/// The demo's renderer on one scene, and the linear picture it shows.
class RealTime {
  public:
    static Result<std::unique_ptr<RealTime>> open(gpu::Device& device,
                                                  const demo::Options& content) {
        std::unique_ptr<RealTime> self(new RealTime);
        auto renderer = demo::Renderer::create(device, {});
        if (!renderer) return renderer.error();
        self->renderer_ = std::move(*renderer);
        if (auto loaded = demo::load_content(*self->renderer_, content); !loaded) {
            return loaded.error();
        }
        // As fine as in a picture that a game would show, not as in this small one.
        auto& maps = self->renderer_->world().resource<light::ShadowSettings>();
        maps = {.size = 512, .fit_to_picture = false};
        self->pixels_ = size_t{content.size[0]} * content.size[1];
        auto buffer = gpu::Buffer::create(device, 8 * self->pixels_, gpu::MemoryKind::kReadback,
                                          "linear picture");
        if (!buffer) return buffer.error();
        self->readback_ = std::move(*buffer);
        self->renderer_->set_overlay([rt = self.get()](auto& frame) {
            display::describe_readback(frame, frame.color, rt->readback_);
        });
        self->renderer_->world().query<const hair::HairTechniques>().each(
            [&](const hair::HairTechniques& chosen) { self->loaded_ = chosen; });
        return self;
    }

    /// The scene's own techniques but for a column's and those of all columns.
    void choose(const std::vector<demo::TechniqueChoice>& column,
                const std::vector<demo::TechniqueChoice>& all) {
        hair::HairTechniques wanted = loaded_;
        for (const auto* choices : {&column, &all}) {
            for (const auto& choice : *choices) {
                static_cast<void>(hair::set_technique(wanted, choice.axis, choice.technique));
            }
        }
        renderer_->world().query<hair::HairTechniques>().each(
            [&](hair::HairTechniques& chosen) { chosen = wanted; });
    }

    /// Mean of some frames, and the median time of their passes of hair.
    Result<Pixels> draw(uint32_t frames, double& hair_ms) {
        Pixels mean(pixels_, glm::dvec3(0.0));
        std::vector<double> times;
        for (uint32_t frame = 0; frame < frames; ++frame) {
            if (auto drawn = renderer_->draw(demo::Output::kPicture); !drawn) return drawn.error();
            if (auto done = renderer_->wait(); !done) return done.error();
            const auto* words = reinterpret_cast<const uint64_t*>(readback_.mapped());
            for (size_t i = 0; i < pixels_; ++i) {
                mean[i] += glm::dvec3(glm::unpackHalf4x16(words[i])) / static_cast<double>(frames);
            }
            double time = 0.0;
            for (const auto& pass : renderer_->report().passes) {
                if (pass.name.starts_with("hair/")) time += pass.gpu_ms;
            }
            times.push_back(time);
        }
        hair_ms = median(times);
        return mean;
    }

  private:
    RealTime() = default;

    std::unique_ptr<demo::Renderer> renderer_;
    gpu::Buffer readback_;
    hair::HairTechniques loaded_;
    size_t pixels_ = 0;
};

Deviation deviation(const Truth& truth, const Pixels& picture, uint32_t size) {
    Deviation result;
    glm::dvec3 sum(0.0);
    glm::dvec3 reference(0.0);
    double apart = 0.0;
    double all = 0.0;
    for (uint32_t top = 0; top < size; top += 8) {
        for (uint32_t left = 0; left < size; left += 8) {
            glm::dvec3 a(0.0);
            glm::dvec3 b(0.0);
            for (uint32_t y = top; y < std::min(top + 8, size); ++y) {
                for (uint32_t x = left; x < std::min(left + 8, size); ++x) {
                    const size_t i = size_t{y} * size + x;
                    if (truth.hair[i] < kFullOfHair) continue;
                    a += picture[i];
                    b += truth.radiance[i];
                }
            }
            sum += a;
            reference += b;
            apart += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
            all += b.r + b.g + b.b;
        }
    }
    result.mean = sum / reference - 1.0;
    result.blocks = apart / all;
    return result;
}

Result<void> save_display(const fs::path& path, const Pixels& left, const Pixels& right,
                          uint32_t size) {
    double brightest = 0.0;
    for (const auto& p : right) brightest += p.g / static_cast<double>(right.size());
    asset::Image image{.width = 2 * size, .height = size, .rgba = {}};
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < 2 * size; ++x) {
            const glm::dvec3 p =
                (x < size ? left : right)[size_t{y} * size + x % size] * (0.25 / brightest);
            for (int c = 0; c < 3; ++c) {
                const double v = p[c] / (0.4 + p[c]) * 1.2;
                image.rgba.push_back(
                    static_cast<uint8_t>(255.0 * std::pow(std::clamp(v, 0.0, 1.0), 1.0 / 2.2)));
            }
            image.rgba.push_back(255);
        }
    }
    return asset::save_png(path, image);
}

std::vector<TruthCase> cases_of(const Options& options) {
    std::vector<TruthCase> cases;
    for (const auto groom : kTruthGrooms) {
        for (const auto colour : kTruthColours) {
            for (const auto light : kTruthLights) {
                const TruthCase one{std::string(groom), std::string(colour), std::string(light)};
                const bool wanted = std::ranges::all_of(options.only, [&](const auto& words) {
                    const auto any = split(words, ',');
                    return std::ranges::any_of(any, [&](const auto& word) {
                        return one.name().find(word) != std::string::npos;
                    });
                });
                if (wanted) cases.push_back(one);
            }
        }
    }
    return cases;
}

void print_line(const std::string& name, const Deviation& d) {
    fmt::print("  {:<52} {:>+6.0f} {:>+6.0f} {:>+6.0f}   {:>5.0f} {:>6.0f} {:>8.1f}\n", name,
               100 * d.mean.r, 100 * d.mean.g, 100 * d.mean.b, 100 * d.colour(), 100 * d.blocks,
               d.hair_ms);
}

using Summary = std::map<std::string, std::map<std::string, std::vector<Deviation>>>;

/// By colour, then by column: means over grooms and lights.
void print_summary(const Summary& summary) {
    fmt::print("\nmean over grooms and lights: colour error %, and of blocks %\n");
    for (const auto& [colour, columns] : summary) {
        for (const auto& [column, all] : columns) {
            double error = 0.0;
            double blocks = 0.0;
            double ms = 0.0;
            for (const Deviation& d : all) {
                error += d.colour() / static_cast<double>(all.size());
                blocks += d.blocks / static_cast<double>(all.size());
                ms += d.hair_ms / static_cast<double>(all.size());
            }
            fmt::print("{:<8} {:<54} {:>5.1f} {:>6.1f} {:>8.1f} ms\n", colour, column, 100 * error,
                       100 * blocks, ms);
        }
    }
}

Result<void> compare_all(const Options& options) {
    std::error_code code;
    fs::create_directories(options.folder, code);
    const fs::path folder = fs::absolute(options.folder);
    if (auto written = write_truth_files(folder); !written) return written;
    auto device = gpu::Device::create({.name = options.device});
    if (!device) return device.error();
    auto both = parse_choices(options.set);
    if (!both) return both.error();
    Summary summary;
    fmt::print(
        "{}x{}, {} samples, {} frames; % off: mean R, G, B, their mean; blocks; ms of hair\n",
        options.size, options.size, options.samples, options.frames);
    for (const TruthCase& one : cases_of(options)) {
        auto scene = write_truth_scene(folder, one);
        if (!scene) return scene.error();
        auto truth = trace(*scene, options, *both);
        if (!truth) return truth.error();
        auto real_time = RealTime::open(**device, content_of(*scene, options));
        if (!real_time) return real_time.error();
        fmt::print("{} (reference ± {:.1f} %)\n", one.name(), 100 * truth->noise);
        for (const std::string& column : options.with) {
            auto choices = parse_choices(column);
            if (!choices) return choices.error();
            (*real_time)->choose(*choices, *both);
            double hair_ms = 0.0;
            auto picture = (*real_time)->draw(options.frames, hair_ms);
            if (!picture) return picture.error();
            Deviation d = deviation(*truth, *picture, options.size);
            d.hair_ms = hair_ms;
            print_line(column, d);
            summary[one.colour][column].push_back(d);
            if (!options.pictures) continue;
            std::string name = one.name() + "_" + column + ".png";
            std::ranges::replace(name, ',', '_');
            if (auto saved = save_display(folder / name, *picture, truth->radiance, options.size);
                !saved) {
                return saved;
            }
        }
    }
    print_summary(summary);
    return {};
}

int run_truth(const Options& options) {
    const auto done = compare_all(options);
    if (!done) fmt::print(stderr, "error: {}\n", done.error().message());
    return done ? 0 : 1;
}

const Registration kTruth(
    {"truth", "real-time hair beside the path tracer's, by groom, colour and light",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         options->with = {
             "shadow=pcf_exponential,scattering=karis,multiple=fake_normal,environment=sh",
             "shadow=deep_opacity,scattering=series_b,multiple=dual,environment=sh_depth"};
         app.add_option("--folder", options->folder,
                        "for scenes and traced pictures, which it keeps");
         app.add_option("--device", options->device, "part of its name");
         app.add_option("--only", options->only,
                        "words in a case's name, e.g. wavy blond,white sky");
         app.add_option("--with", options->with, "techniques of a column: axis=id,axis=id");
         app.add_option("--set", options->set, "techniques of all columns and of the path tracer");
         app.add_option("--size", options->size, "pixels along a side")
             ->check(CLI::Range(16, 2048));
         app.add_option("--samples", options->samples, "of the path tracer in a pixel")
             ->check(CLI::Range(2, 65536));
         app.add_option("--frames", options->frames, "that a real-time picture is the mean of")
             ->check(CLI::Range(1, 4096));
         app.add_flag("--pictures", options->pictures, "PNGs: real time, path tracer");
         return [options] { return run_truth(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
