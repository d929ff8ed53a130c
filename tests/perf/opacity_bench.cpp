#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/platform/files.h"
#include "tests/perf/bench.h"
#include "tests/perf/hair_rig.h"

// How near dithered opacity comes to the truth: error of the mean coverage against a picture of 64
// samples a pixel, and flicker over 16 still frames.
namespace vellus::bench {

namespace {

constexpr uint32_t kSupersample = 8;
constexpr int kReferenceFrames = 8;
constexpr int kWarmUp = 32;
constexpr int kStillFrames = 16;

struct Options {
    HairRigOptions rig{.width = 320, .height = 180, .white = true};
    std::string json;
};

struct Quality {
    std::string name;
    double bias = 0.0;     ///< mean coverage minus the reference's, over it
    double error = 0.0;    ///< mean |difference| of the 16-frame mean, over the reference's mean
    double single = 0.0;   ///< the same of one frame
    double flicker = 0.0;  ///< mean standard deviation over frames, over the reference's mean
};

Result<std::vector<float>> reference(const Options& options) {
    HairRigOptions large = options.rig;
    large.width *= kSupersample;
    large.height *= kSupersample;
    large.temporal = false;
    auto rig = HairRig::create(large);
    if (!rig) return rig.error();
    std::vector<double> sums(size_t{options.rig.width} * options.rig.height);
    for (int frame = 0; frame < kReferenceFrames; ++frame) {
        if (auto drawn = (*rig)->draw(Wanted::kLinear); !drawn) return drawn.error();
        const auto values = (*rig)->values();
        for (size_t i = 0; i < values.size(); ++i) {
            const size_t x = i % large.width / kSupersample;
            const size_t y = i / large.width / kSupersample;
            sums[y * options.rig.width + x] += values[i];
        }
    }
    std::vector<float> mean(sums.size());
    for (size_t i = 0; i < sums.size(); ++i) {
        mean[i] = static_cast<float>(sums[i] / (kSupersample * kSupersample * kReferenceFrames));
    }
    return mean;
}

Result<Quality> measure(const Options& options, const std::vector<float>& truth,
                        const std::string& name, bool temporal, hair::OpacityTechnique technique) {
    HairRigOptions small = options.rig;
    small.temporal = temporal;
    small.techniques.opacity = technique;
    auto rig = HairRig::create(small);
    if (!rig) return rig.error();
    for (int frame = 0; frame < kWarmUp; ++frame) {
        if (auto drawn = (*rig)->draw(Wanted::kLinear); !drawn) return drawn.error();
    }
    std::vector<double> sum(truth.size());
    std::vector<double> squares(truth.size());
    std::vector<float> last;
    for (int frame = 0; frame < kStillFrames; ++frame) {
        if (auto drawn = (*rig)->draw(Wanted::kLinear); !drawn) return drawn.error();
        last = (*rig)->values();
        for (size_t i = 0; i < last.size(); ++i) {
            sum[i] += last[i];
            squares[i] += double{last[i]} * last[i];
        }
    }
    Quality quality{.name = name};
    double total = 0.0;
    for (size_t i = 0; i < truth.size(); ++i) {
        const double mean = sum[i] / kStillFrames;
        total += truth[i];
        quality.bias += mean - truth[i];
        quality.error += std::abs(mean - truth[i]);
        quality.single += std::abs(last[i] - truth[i]);
        quality.flicker += std::sqrt(std::max(squares[i] / kStillFrames - mean * mean, 0.0));
    }
    quality.bias /= total;
    quality.error /= total;
    quality.single /= total;
    quality.flicker /= total;
    return quality;
}

int run_opacity(const Options& options) {
    auto truth = reference(options);
    if (!truth) {
        fmt::print(stderr, "error: {}\n", truth.error().message());
        return 1;
    }
    fmt::print("coverage of {} at {}x{} against {} samples a pixel; shares of the mean coverage\n",
               options.rig.groom, options.rig.width, options.rig.height,
               kSupersample * kSupersample);
    fmt::print("{:<24} {:>9} {:>12} {:>12} {:>9}\n", "technique", "bias", "error, mean",
               "error, one", "flicker");
    nlohmann::json json = nlohmann::json::array();
    using enum hair::OpacityTechnique;
    const struct {
        const char* name;
        bool temporal;
        hair::OpacityTechnique technique;
    } kCases[] = {{"dither with TAA", true, kDither},
                  {"dither without TAA", false, kDither},
                  {"dither_still with TAA", true, kDitherStill},
                  {"dither_still without TAA", false, kDitherStill}};
    for (const auto& item : kCases) {
        auto quality = measure(options, *truth, item.name, item.temporal, item.technique);
        if (!quality) {
            fmt::print(stderr, "error: {}\n", quality.error().message());
            return 1;
        }
        fmt::print("{:<24} {:>8.2f}% {:>11.2f}% {:>11.2f}% {:>8.2f}%\n", quality->name,
                   100 * quality->bias, 100 * quality->error, 100 * quality->single,
                   100 * quality->flicker);
        json.push_back({{"name", quality->name},
                        {"bias", quality->bias},
                        {"error", quality->error},
                        {"single_frame_error", quality->single},
                        {"flicker", quality->flicker}});
    }
    if (options.json.empty()) return 0;
    auto written = write_file(options.json, std::string_view(json.dump(2)));
    if (!written) fmt::print(stderr, "error: {}\n", written.error().message());
    return written ? 0 : 1;
}

const Registration kOpacity(
    {"opacity", "coverage error and flicker of dithered opacity against 64 samples a pixel",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         options->rig.techniques.shadow = hair::ShadowTechnique::kNone;
         app.add_option("--groom", options->rig.groom, "groom file");
         app.add_option("--device", options->rig.device, "part of its name");
         app.add_option("--width", options->rig.width, "pixels")->check(CLI::Range(1, 2048));
         app.add_option("--height", options->rig.height, "pixels")->check(CLI::Range(1, 2048));
         app.add_option("--json", options->json, "file for the rows");
         return [options] { return run_opacity(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
