#pragma once

#include "shaders/common/portable.h"

/// The shader's own functions, compiled as C++ in float.
namespace vellus::hair::glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "hair/environment/cover.glsl"
}  // namespace vellus::hair::glsl
