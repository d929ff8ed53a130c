#include "game_demo/src/accuracy/table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/platform/files.h"
#include "engine/platform/quantile.h"

namespace vellus::demo {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

Json spread_json(const Spread& spread) {
    return {{"median", spread.median}, {"p10", spread.low}, {"p90", spread.high}};
}

Spread spread_from(const Json& json) {
    return {json.at("median"), json.at("p10"), json.at("p90")};
}

AccuracyRow row_from(const Json& json) {
    AccuracyRow row;
    for (auto [name, slot] : {std::pair{"id", &row.id},
                              {"axis", &row.axis},
                              {"technique", &row.technique},
                              {"setting", &row.setting},
                              {"groom", &row.groom},
                              {"colour", &row.colour},
                              {"light", &row.light},
                              {"device", &row.device},
                              {"run", &row.run}}) {
        *slot = json.at(name).get<std::string>();
    }
    row.reference = json.at("reference");
    row.error = json.at("error");
    for (const auto& [name, value] : json.at("measures").items()) row.measures[name] = value;
    row.axis_ms = spread_from(json.at("axis_ms"));
    row.frame_ms = spread_from(json.at("frame_ms"));
    row.transient_bytes = json.at("transient_bytes");
    row.persistent_bytes = json.at("persistent_bytes");
    row.frames = json.at("frames");
    row.pictures = json.at("pictures");
    return row;
}

/// `read` on the file's JSON; what it throws becomes an Error.
template <class Read>
auto read_json(const std::filesystem::path& path, Read read) -> Result<decltype(read(Json()))> {
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    const Error wrong{"holds no rows of vellus_accuracy", path.string(),
                      "make them with vellus_accuracy --out DIR"};
    const auto* text = reinterpret_cast<const char*>(bytes->data());
    const auto json = Json::parse(text, text + bytes->size(), nullptr, false);
    if (json.is_discarded()) return wrong;
    try {
        return read(json);
    } catch (const nlohmann::json::exception& problem) {
        return Error{wrong.what + ": " + problem.what(), wrong.where, wrong.remedy};
    }
}

}  // namespace

Spread spread_of(std::vector<double> samples) {
    if (samples.empty()) return {};
    std::ranges::sort(samples);
    return {quantile(samples, 0.5), quantile(samples, 0.1), quantile(samples, 0.9)};
}

std::string_view error_name(std::string_view axis) {
    if (axis == "opacity") return "coverage error of a single frame, relative L1";
    if (axis == "shadow") return "mean |ΔV| of visible hair";
    return "relative L1 of linear radiance";
}

nlohmann::ordered_json row_json(const AccuracyRow& row) {
    return {{"id", row.id},
            {"axis", row.axis},
            {"technique", row.technique},
            {"setting", row.setting},
            {"groom", row.groom},
            {"colour", row.colour},
            {"light", row.light},
            {"reference", row.reference},
            {"error", row.error},
            {"measures", row.measures},
            {"axis_ms", spread_json(row.axis_ms)},
            {"frame_ms", spread_json(row.frame_ms)},
            {"transient_bytes", row.transient_bytes},
            {"persistent_bytes", row.persistent_bytes},
            {"frames", row.frames},
            {"pictures", row.pictures},
            {"device", row.device},
            {"run", row.run}};
}

std::string to_json(const AccuracyTable& table) {
    Json rows = Json::array();
    for (const AccuracyRow& row : table.rows) rows.push_back(row_json(row));
    const Json json = {{"version", kVersion},    {"device", table.device},
                       {"driver", table.driver}, {"command", table.command},
                       {"date", table.date},     {"seed", table.seed},
                       {"size", table.size},     {"rows", rows}};
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Result<AccuracyRow> load_accuracy_row(const std::filesystem::path& path) {
    return read_json(path, [](const Json& json) { return row_from(json); });
}

Result<AccuracyTable> load_accuracy(const std::filesystem::path& path) {
    return read_json(path, [](const Json& json) {
        AccuracyTable table;
        table.device = json.at("device");
        table.driver = json.at("driver");
        table.command = json.at("command");
        table.date = json.at("date");
        table.seed = json.at("seed");
        table.size = json.at("size");
        for (const Json& row : json.at("rows")) table.rows.push_back(row_from(row));
        return table;
    });
}

}  // namespace vellus::demo
