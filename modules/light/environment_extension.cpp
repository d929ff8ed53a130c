#include "modules/light/environment_extension.h"

#include "engine/asset/json_fields.h"

namespace vellus::light {

namespace {

constexpr double kBrightest = 1e6;
constexpr double kMostTurn = 1e3;
constexpr double kMostStops = 32.0;

}  // namespace

Result<EnvironmentExtension> parse_environment_extension(std::string_view json,
                                                         const std::string& where) {
    const auto parsed = asset::parse_json(json, where);
    if (!parsed) return parsed.error();
    asset::JsonFields fields(*parsed, where);
    EnvironmentExtension environment;
    fields.text("image", environment.image);
    if (environment.image.empty()) {
        fields.fail("image", "is missing or empty", "name a latitude-longitude .hdr or .exr file");
    }
    fields.number("intensity", 0.0, kBrightest, environment.intensity);
    fields.number("rotation", -kMostTurn, kMostTurn, environment.rotation);
    fields.number("exposure", -kMostStops, kMostStops, environment.exposure);
    if (fields.error()) return *fields.error();
    environment.warnings = fields.unknown_fields();
    return environment;
}

}  // namespace vellus::light
