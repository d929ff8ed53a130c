#include <fmt/ostream.h>

#include <filesystem>
#include <memory>

#include "engine/platform/clock.h"
#include "game_demo/tools/groom/command.h"
#include "modules/hair/cards/build_cards.h"
#include "modules/hair/cards/card_file.h"
#include "modules/hair/groom/load_strands.h"

namespace vellus::groom_tool {

namespace {

struct Options {
    std::filesystem::path groom;
    std::filesystem::path out;
    hair::CardBuildOptions build;
};

Result<uint64_t> bytes_on_disk(const std::filesystem::path& gltf) {
    uint64_t sum = 0;
    const std::string stem = gltf.stem().string();
    for (const std::string& name :
         {stem + ".gltf", stem + ".bin", stem + "_color.png", stem + "_tangent.png",
          stem + "_depth.png", stem + "_root.png", stem + "_strand.png", stem + "_fibres.png"}) {
        std::error_code code;
        const uint64_t bytes = std::filesystem::file_size(gltf.parent_path() / name, code);
        if (code) return Error{"is not there after writing", name, "check the disk"};
        sum += bytes;
    }
    return sum;
}

Result<void> run(const Options& options, std::ostream& out) {
    if (options.out.extension() != ".gltf") {
        return Error{"cards are written as .gltf with .bin and .png files beside it",
                     options.out.string(), "name it .gltf"};
    }
    auto loaded = hair::load_strands(options.groom, true);
    if (!loaded) return loaded.error();
    fmt::print(out, "{}: {} strands\n", options.groom.string(), loaded->strands.strand_count());
    out.flush();
    auto built = hair::build_cards(loaded->strands, options.build);
    if (!built) return Error{built.error().what, options.groom.string(), built.error().remedy};
    fmt::print(out, "{}\n", hair::to_text(built->report));
    out.flush();
    const double start = wall_seconds();
    if (auto saved = hair::save_cards(built->cards, options.out); !saved) return saved;
    auto bytes = bytes_on_disk(options.out);
    if (!bytes) return bytes.error();
    fmt::print(out, "{}: {:.1f} MiB with its textures, written in {:.2f} s\n", options.out.string(),
               static_cast<double>(*bytes) / (1U << 20U), wall_seconds() - start);
    return {};
}

Action attach(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.add_option("groom", options->groom, "Groom: .hair, .tfx, glTF line strips")
        ->required()
        ->type_name("GROOM");
    app.add_option("out", options->out, "Cards: .gltf, textures beside it")
        ->required()
        ->type_name("CARDS");
    hair::CardBuildOptions& build = options->build;
    app.add_option(
           "--cards", build.cards,
           "At most this many (0: 300, or 900 to 4000 where hair is short, curled or gathered)")
        ->capture_default_str();
    app.add_option("--density", build.texels_per_metre,
                   "Texels per metre across the cards; 0: one per strand width")
        ->capture_default_str();
    app.add_option("--along", build.along_ratio, "Texels along the cards for each across")
        ->capture_default_str();
    app.add_option("--max-texels", build.max_texels, "Of the atlas")->capture_default_str();
    app.add_option("--rows", build.max_rows, "Most rows of a card")->capture_default_str();
    app.add_option("--tolerance", build.tolerance, "Metres that a card may cut a bend")
        ->capture_default_str();
    app.add_option("--tip-scale", build.tip_scale, "Width left at the strands' tips")
        ->capture_default_str();
    return [options](std::ostream& out) { return run(*options, out); };
}

}  // namespace

const Command kCards{"cards", "Builds textured cards that stand for a groom's strands", attach};

}  // namespace vellus::groom_tool
