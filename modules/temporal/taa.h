#pragma once

#include "shaders/common/portable.h"

/// The shader's own functions, compiled as C++ in float.
namespace vellus::temporal::glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "temporal/taa.glsl"
}  // namespace vellus::temporal::glsl
