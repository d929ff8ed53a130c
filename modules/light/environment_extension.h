#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::light {

constexpr std::string_view kEnvironmentExtensionName = "VELLUS_environment";

/// VELLUS_environment on the glTF scene: the sky that surrounds and lights it.
/// assets/schema/VELLUS_environment.schema.json is the format for people and editors.
struct EnvironmentExtension {
    /// Latitude-longitude HDR or EXR, relative to the glTF file.
    std::string image;
    /// Factor on the image's radiance, in [0, 1e6].
    float intensity = 1.0f;
    /// Radians about +Y, counter-clockwise seen from above.
    float rotation = 0.0f;
    /// Exposure of the picture in stops, in [-32, 32].
    float exposure = 0.0f;
    /// Unknown fields, one line each; the caller logs them.
    std::vector<std::string> warnings;
};

/// Parses the extension's JSON. `where` names the file in messages. A field of the wrong type or
/// outside its range is an Error that names the field and what is allowed; unknown fields are
/// warnings.
Result<EnvironmentExtension> parse_environment_extension(std::string_view json,
                                                         const std::string& where);

}  // namespace vellus::light
