#pragma once

#include <span>
#include <vector>

#include "engine/asset/image.h"
#include "engine/platform/result.h"
#include "game_demo/tools/accuracy/radiance.h"

namespace vellus::demo {

/// Factor that makes hair of the reference a middling grey on the display, whatever its colour.
float exposure_for(const Reference& reference);
/// sRGB-encoded colours in [0, 1] as the demo's display makes them; `exposure` 0: values in [0, 1]
/// that are shown as they are (coverage, transmittance).
std::vector<glm::vec3> displayed(const Radiance& picture, float exposure);

asset::Image to_image(const std::vector<glm::vec3>& shown, glm::uvec2 size);
/// Errors in [0, 1] from black over red to pale yellow (after matplotlib's magma).
asset::Image heat_map(std::span<const float> errors, glm::uvec2 size);

/// Small enough for a page of many: JPEG of quality 88.
Result<std::vector<std::byte>> encode_jpeg(const asset::Image& image);

}  // namespace vellus::demo
