#include "assets/generator/gltf_values.h"

#include <algorithm>
#include <cmath>

namespace vellus::sculpt {

using glm::dvec3;

double tidy(double x) {
    return std::round(x * 1e6) / 1e6 + 0.0;
}

Json list(dvec3 v) {
    return Json::array({tidy(v.x), tidy(v.y), tidy(v.z)});
}

Json list(glm::dquat q) {
    return Json::array({q.x, q.y, q.z, q.w});
}

glm::dquat facing(dvec3 direction) {
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), z));
    return glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
}

uint16_t unorm16(double x) {
    return static_cast<uint16_t>(std::lround(std::clamp(x, 0.0, 1.0) * 65535.0));
}

glm::u16vec4 unorm_shares(const std::array<double, 4>& shares) {
    const uint16_t b = unorm16(shares[1]);
    const uint16_t c = unorm16(shares[2]);
    const uint16_t d = unorm16(shares[3]);
    return {static_cast<uint16_t>(65535 - b - c - d), b, c, d};
}

}  // namespace vellus::sculpt
