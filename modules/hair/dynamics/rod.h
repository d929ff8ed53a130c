#pragma once

#include "modules/hair/dynamics/rod_lanes.h"
#include "shaders/common/portable.h"

/// What the device is told, as it reads it.
namespace vellus::hair::glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "hair/dynamics/rod_params.glsl"
}  // namespace vellus::hair::glsl

/// The shader's own solver over four guides at once. The step itself (rod_step.glsl) is included by
/// the struct that holds the columns it works on: simulate.cpp.
namespace vellus::hair::lanes {
using namespace vellus::hair::glsl;  // NOLINT(google-build-using-namespace)
using real = Lanes;
using rmask = Lanes::Bits;
using rvec3 = RodVec3<Lanes>;
using rvec4 = RodVec4<Lanes>;
// Each builds on the one before.
// clang-format off
#include "hair/dynamics/rod_math.glsl"
#include "hair/dynamics/rod_link.glsl"
#include "hair/dynamics/rod_contact.glsl"
// clang-format on
inline rvec3 rod_spread(vec3 v) {
    return {v.x, v.y, v.z};
}
}  // namespace vellus::hair::lanes
