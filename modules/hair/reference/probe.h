#pragma once

#include "shaders/common/portable.h"

/// All shading mathematics at once, as C++; the stability tests' view of the shaders.
namespace vellus::hair::probe {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "hair/reference/probe.glsl"
}  // namespace vellus::hair::probe
