#include <fmt/ostream.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "game_demo/tools/groom/command.h"
#include "modules/hair/groom/convert.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/upright.h"

namespace vellus::groom_tool {

namespace {

struct Options {
    std::vector<std::filesystem::path> files;
    bool json = false;
};

std::vector<std::string> columns_of(const hair::Groom& groom) {
    std::vector<std::string> columns;
    const auto add = [&](bool present, const char* name) {
        if (present) columns.emplace_back(name);
    };
    add(!groom.thickness.empty(), groom.thickness.size() == groom.points.size()
                                      ? "diameter per point"
                                      : "diameter per strand");
    add(groom.thickness.empty() && groom.default_thickness > 0.0f, "one diameter");
    add(!groom.colors.empty(), "colour per point");
    add(groom.colors.empty() && groom.has_default_color, "one colour");
    add(!groom.transparency.empty(), "transparency per point");
    add(!groom.strand_uvs.empty(), "texture coordinates of roots");
    add(!groom.point_uvs.empty(), "texture coordinates of points");
    add(!groom.inverse_mass.empty(), "held points");
    return columns;
}

nlohmann::json to_json(const std::filesystem::path& path, const hair::LoadedGroom& loaded,
                       const hair::Upright& upright, double width) {
    const hair::GroomReport& report = loaded.report;
    const auto list = [](auto v) { return nlohmann::json{v.x, v.y, v.z}; };
    return {
        {"file", path.string()},
        {"format", hair::format_name(loaded.groom.format)},
        {"strands", report.strands},
        {"points", report.points},
        {"segments", report.segments},
        {"points_per_strand", {report.min_points, report.max_points}},
        {"length",
         {{"min", report.min_length}, {"mean", report.mean_length}, {"max", report.max_length}}},
        {"box", {list(report.bounds.low), list(report.bounds.high)}},
        {"columns", columns_of(loaded.groom)},
        {"info", loaded.groom.info},
        {"metres_per_unit", upright.metres_per_unit},
        {"upright", upright.reason},
        {"width_m", width},
        {"clean", report.clean()},
        {"report", hair::to_text(report)}};
}

Result<void> run(const Options& options, std::ostream& out) {
    nlohmann::json all = nlohmann::json::array();
    for (const auto& path : options.files) {
        auto loaded = hair::load_groom(path);
        if (!loaded) return loaded.error();
        const hair::Upright upright = hair::upright_transform(loaded->groom);
        const double width = hair::default_width(loaded->groom, upright.metres_per_unit);
        if (options.json) {
            all.push_back(to_json(path, *loaded, upright, width));
            continue;
        }
        fmt::print(out, "{}: {}\n", path.string(), hair::format_name(loaded->groom.format));
        if (!loaded->groom.info.empty()) fmt::print(out, "\"{}\"\n", loaded->groom.info);
        const auto columns = columns_of(loaded->groom);
        if (!columns.empty()) fmt::print(out, "has {}\n", fmt::join(columns, ", "));
        fmt::print(out, "{}\n", upright.reason);
        fmt::print(out, "drawn {:.3g} mm wide, {:.3g} x {:.3g} x {:.3g} m\n", 1e3 * width,
                   upright.high.x - upright.low.x, upright.high.y - upright.low.y,
                   upright.high.z - upright.low.z);
        fmt::print(out, "{}", hair::to_text(loaded->report));
    }
    if (options.json) {
        out << all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    }
    return {};
}

Action attach(CLI::App& app) {
    auto options = std::make_shared<Options>();
    app.add_option("files", options->files, "Grooms: .hair, .tfx, glTF line strips")
        ->required()
        ->type_name("GROOM...");
    app.add_flag("--json", options->json, "As a JSON array");
    return [options](std::ostream& out) { return run(*options, out); };
}

}  // namespace

const Command kInfo{"info", "Says what a groom holds and what is wrong with it", attach};

}  // namespace vellus::groom_tool
