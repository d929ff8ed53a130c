#pragma once

#include <glm/glm.hpp>

/// GLSL's types and built-ins for the mathematics headers below shaders/.
namespace vellus::glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): GLSL has no other vocabulary
#include "common/portable.glsl"
}  // namespace vellus::glsl
