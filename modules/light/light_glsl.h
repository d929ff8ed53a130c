#pragma once

#include "shaders/common/portable.h"

/// The shader's own functions, compiled as C++ in float.
namespace vellus::light::glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "light/equirect.glsl"
#include "light/sh.glsl"
}  // namespace vellus::light::glsl
