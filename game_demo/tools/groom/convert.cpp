#include "modules/hair/groom/convert.h"

#include <fmt/ostream.h>

#include <filesystem>
#include <memory>

#include "game_demo/tools/groom/command.h"
#include "game_demo/tools/groom/save.h"

namespace vellus::groom_tool {

namespace {

struct Options {
    std::filesystem::path from;
    std::filesystem::path to;
    uint32_t points = 0;
    bool keep_axes = false;
};

Result<void> run(const Options& options, std::ostream& out) {
    if (auto ok = check_target(options.to); !ok) return ok;
    auto loaded = hair::load_groom(options.from);
    if (!loaded) return loaded.error();
    if (!loaded->report.clean()) fmt::print(out, "{}", hair::to_text(loaded->report));
    hair::Groom& groom = loaded->groom;
    if (options.points > 0) groom = hair::resample_groom(groom, options.points);
    return save(groom, options.to, options.keep_axes, out);
}

Action attach(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.add_option("from", options->from, "The groom to read")->required()->type_name("GROOM");
    app.add_option("to", options->to, "The file to write: .hair, .tfx (4.0) or .glb")
        ->required()
        ->type_name("FILE");
    app.add_option("--points", options->points,
                   "Points of each strand, evenly spaced; as they are if not given")
        ->check(CLI::Range(2u, 65536u))
        ->type_name("N");
    app.add_flag("--keep-axes", options->keep_axes,
                 "Leave axes and unit; else .hair becomes Z up in centimetres, others Y up in "
                 "metres");
    return [options](std::ostream& out) { return run(*options, out); };
}

}  // namespace

const Command kConvert{"convert", "Writes a groom in another format", attach};

}  // namespace vellus::groom_tool
