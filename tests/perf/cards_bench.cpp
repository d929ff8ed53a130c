#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>

#include "engine/platform/clock.h"
#include "tests/perf/bench.h"
#include "tests/support/card_views.h"

// Cards beside the strands they were built from, from eight sides: what a viewer would notice.
namespace vellus::bench {

namespace {

using test::CardComparison;
using test::CardPicture;
using test::CardViews;

constexpr int kSides = 8;

struct Options {
    std::vector<std::string> grooms{"assets/grooms/long.hair"};
    std::string body;
    hair::HairTechniques techniques;
    std::string device;
    std::string pictures;
    uint32_t size = 384;
    int frames = 16;
    double distance = 1.0;
    uint32_t finer = 1;
    hair::CardBuildOptions build;
};

/// The two pictures side by side.
asset::Image beside(const asset::Image& left, const asset::Image& right) {
    asset::Image both{.width = left.width + right.width, .height = left.height, .rgba = {}};
    for (uint32_t y = 0; y < left.height; ++y) {
        for (const asset::Image* image : {&left, &right}) {
            const auto row = image->rgba.begin() + ptrdiff_t{4} * y * image->width;
            both.rgba.insert(both.rgba.end(), row, row + ptrdiff_t{4} * image->width);
        }
    }
    return both;
}

/// Means over blocks of `factor` x `factor` pixels.
CardPicture reduce(const CardPicture& fine, uint32_t factor) {
    CardPicture picture = CardPicture::blank(fine.size / factor);
    const float share = 1.0f / static_cast<float>(factor * factor);
    for (size_t i = 0; i < fine.color.size(); ++i) {
        const size_t x = i % fine.size.x / factor;
        const size_t y = i / fine.size.x / factor;
        if (x >= picture.size.x || y >= picture.size.y) continue;
        picture.color[y * picture.size.x + x] += share * fine.color[i];
        picture.coverage[y * picture.size.x + x] += share * fine.coverage[i];
        picture.body[y * picture.size.x + x] += share * fine.body[i];
        picture.alone[y * picture.size.x + x] += share * fine.alone[i];
    }
    return picture;
}

/// Device times of the hair passes of the last frame.
void print_passes(const char* title, graph::Executor& executor) {
    std::map<std::string, double> times;
    for (const graph::PassReport& pass : executor.report().passes) {
        if (pass.name.starts_with("hair/")) times[std::string(pass.name)] += pass.gpu_ms;
    }
    fmt::print("{}:", title);
    for (const auto& [name, time] : times) fmt::print(" {} {:.1f} ms", name.substr(5), time);
    fmt::print("\n");
}

/// Of all sides, the farthest from the strands, as shares.
struct Worst {
    double luminance = 0.0;
    double silhouette = 0.0;
    double outline = 0.0;
    double coverage = 0.0;
    int bald_blocks = 0;
    hair::CardReport report;

    void add(const CardComparison& c) {
        luminance = std::max(luminance, std::abs(c.luminance_error()));
        silhouette = std::max(silhouette, std::abs(c.silhouette_error()));
        outline = std::max(outline, std::abs(c.outline_error()));
        coverage = std::max(coverage, std::abs(c.coverage_error()));
        bald_blocks += c.bald_blocks;
    }
};

Result<Worst> compare_sides(gpu::Device& device, const Options& options, const std::string& groom) {
    Worst worst;
    auto strands = test::load_upright_strands(groom);
    if (!strands) return strands.error();
    auto built = hair::build_cards(*strands, options.build);
    if (!built) return built.error();
    worst.report = built->report;
    fmt::print("{}: {}\n", groom, hair::to_text(built->report));
    auto views = CardViews::create(device, glm::uvec2(options.size * options.finer));
    if (!views) return views.error();
    if (!options.body.empty()) {
        if (auto worn = (*views)->wear_on(options.body); !worn) return worn.error();
    }
    World& world = (*views)->world();
    *world.get<hair::HairTechniques>((*views)->hair()) = options.techniques;
    auto strand_groom = hair::add_strands(world, device, "strands", *strands, {});
    if (!strand_groom) return strand_groom.error();
    auto card_groom = hair::add_cards(world, device, "cards", built->cards);
    if (!card_groom) return card_groom.error();
    auto& library = world.resource<hair::HairLibrary>();
    const auto outermost = library.grooms[*strand_groom].outermost;
    fmt::print("on the device: strands {:.1f} MiB, cards {:.1f} MiB\n",
               static_cast<double>(library.grooms[*strand_groom].strands.bytes()) / (1U << 20U),
               static_cast<double>(library.grooms[*card_groom].strands.bytes() +
                                   library.grooms[*card_groom].cards.bytes()) /
                   (1U << 20U));
    fmt::print("{:>5} {:>21} {:>7} {:>21} {:>7} {:>8} {:>8} {:>11} {:>15}\n", "side",
               "mean luminance", "error", "silhouette px", "error", "outline", "coverage",
               "bald blocks", "CPU ms a frame");
    for (int side = 0; side < kSides; ++side) {
        const double yaw = side * 2.0 * std::numbers::pi / kSides;
        CardPicture pictures[2];
        double milliseconds[2] = {};
        for (int k = 0; k < 2; ++k) {
            (*views)->show(k == 0 ? *strand_groom : *card_groom);
            const double start = process_cpu_seconds();
            auto picture = (*views)->draw(outermost, yaw, options.distance, options.frames);
            if (!picture) return picture.error();
            milliseconds[k] = (process_cpu_seconds() - start) * 1e3 / options.frames;
            pictures[k] = options.finer > 1 ? reduce(*picture, options.finer) : std::move(*picture);
            if (side + 1 == kSides) {
                print_passes(k == 0 ? "strands" : "cards", (*views)->executor());
            }
        }
        const CardComparison c = test::compare(pictures[0], pictures[1]);
        worst.add(c);
        fmt::print(
            "{:>5} {:>10.4f} {:>10.4f} {:>+6.1f}% {:>10.0f} {:>10.0f} {:>+6.1f}% {:>+7.1f}% "
            "{:>+7.1f}% {:>5} / {:>3} {:>7.1f} {:>7.1f}\n",
            side, c.luminance[0], c.luminance[1], 100.0 * c.luminance_error(), c.silhouette[0],
            c.silhouette[1], 100.0 * c.silhouette_error(), 100.0 * c.outline_error(),
            100.0 * c.coverage_error(), c.bald_blocks, c.full_blocks, milliseconds[0],
            milliseconds[1]);
        if (options.pictures.empty()) continue;
        const auto exposure = static_cast<float>(0.35 / c.luminance[0]);
        auto saved = asset::save_png(
            fmt::format("{}/{}_side_{}.png", options.pictures,
                        std::filesystem::path(groom).stem().string(), side),
            beside(test::to_image(pictures[0], exposure), test::to_image(pictures[1], exposure)));
        if (!saved) return saved.error();
    }
    return worst;
}

/// A line per groom: the worst of its sides, and what its cards cost.
void print_worst(const std::string& groom, const Worst& worst) {
    const hair::CardReport& r = worst.report;
    fmt::print(
        "{:>12} {:>8} {:>6} {:>9.1f}% {:>9.1f}% {:>7.1f}% {:>8.1f}% {:>5} {:>8.1f} {:>8.2f}\n",
        std::filesystem::path(groom).stem().string(), r.strands, r.cards, 100.0 * worst.luminance,
        100.0 * worst.silhouette, 100.0 * worst.outline, 100.0 * worst.coverage, worst.bald_blocks,
        static_cast<double>(r.bytes) / (1U << 20U),
        r.cluster_seconds + r.fit_seconds + r.bake_seconds);
}

void set(hair::HairTechniques& techniques, const std::string& choice) {
    const size_t equals = std::min(choice.find('='), choice.size());
    const std::string axis = choice.substr(0, equals);
    const std::string id = choice.substr(std::min(equals + 1, choice.size()));
    if (auto done = hair::set_technique(techniques, axis, id); !done) {
        throw CLI::ValidationError("--set", done.error().message());
    }
}

int run_cards(const Options& options) {
    auto device = gpu::Device::create({.name = options.device});
    if (!device) {
        fmt::print(stderr, "error: {}\n", device.error().message());
        return 1;
    }
    std::vector<Worst> table;
    for (const std::string& groom : options.grooms) {
        auto worst = compare_sides(**device, options, groom);
        if (!worst) {
            fmt::print(stderr, "error: {}\n", worst.error().message());
            return 1;
        }
        table.push_back(*worst);
    }
    fmt::print(
        "worst of {} sides\n{:>12} {:>8} {:>6} {:>10} {:>10} {:>8} {:>9} {:>5} {:>8} {:>8}\n",
        kSides, "groom", "strands", "cards", "luminance", "silhouette", "outline", "coverage",
        "bald", "MiB", "s");
    for (size_t i = 0; i < table.size(); ++i) print_worst(options.grooms[i], table[i]);
    return 0;
}

const Registration kCards(
    {"cards", "cards beside the strands they were built from, from eight sides",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         app.add_option("--groom", options->grooms, "groom files, one table of all at the end");
         app.add_option("--body", options->body, "glTF file whose meshes wear the grooms");
         app.add_option_function<std::vector<std::string>>(
             "--set",
             [options](const std::vector<std::string>& choices) {
                 for (const std::string& choice : choices) set(options->techniques, choice);
             },
             "techniques of both, AXIS=TECHNIQUE");
         app.add_option("--device", options->device, "part of its name");
         app.add_option("--pictures", options->pictures, "folder for pictures: strands, cards");
         app.add_option("--size", options->size, "pixels")->check(CLI::Range(16, 4096));
         app.add_option("--frames", options->frames, "frames a picture is the mean of")
             ->check(CLI::Range(1, 1024));
         app.add_option("--distance", options->distance, "1 fills the picture")
             ->check(CLI::Range(1.0, 100.0));
         app.add_option("--finer", options->finer, "draws so many times as fine and averages")
             ->check(CLI::Range(1, 16));
         app.add_option("--cards", options->build.cards, "most cards to build (0: chosen)");
         app.add_option("--density", options->build.texels_per_metre, "texels per metre across");
         app.add_option("--along", options->build.along_ratio, "texels along for each across");
         app.add_option("--tolerance", options->build.tolerance, "metres a card may cut a bend");
         app.add_option("--rows", options->build.max_rows, "most rows of a card");
         app.add_option("--max-texels", options->build.max_texels, "of the atlas");
         return [options] { return run_cards(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
