#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

namespace vellus::sculpt {

using Json = nlohmann::ordered_json;

// glTF's numbers for component types.
constexpr int kUint8 = 5121;
constexpr int kInt16 = 5122;
constexpr int kUint16 = 5123;
constexpr int kFloat = 5126;

/// Rounded to a millionth, which keeps the file readable.
double tidy(double x);
Json list(glm::dvec3 v);
/// x, y, z, w.
Json list(glm::dquat q);
/// Turns -Z to `direction` and keeps +Y up.
glm::dquat facing(glm::dvec3 direction);

/// [0, 1] as a normalised 16-bit number; what lies outside is clamped.
uint16_t unorm16(double x);
/// Shares as 16-bit numbers that add up to one exactly.
glm::u16vec4 unorm_shares(const std::array<double, 4>& shares);

}  // namespace vellus::sculpt
