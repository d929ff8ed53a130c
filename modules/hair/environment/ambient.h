#pragma once

#include "modules/light/light_glsl.h"
#include "shaders/common/portable.h"

/// The shader's own functions, compiled as C++ in float; the sky's are those of light.
namespace vellus::hair::glsl {
using namespace vellus::glsl;         // NOLINT(google-build-using-namespace)
using namespace vellus::light::glsl;  // NOLINT(google-build-using-namespace)
#include "hair/environment/ambient.glsl"
#include "hair/scattering/scattering.glsl"
}  // namespace vellus::hair::glsl
