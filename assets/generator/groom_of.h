#pragma once

#include <span>

#include "assets/generator/hair_style.h"
#include "modules/hair/groom/groom.h"

namespace vellus::sculpt {

/// Strands in sculpting space (metres, Y up) as the .hair format has them: centimetres, Z up, so
/// the face looks along -Y. `thickness` in centimetres.
hair::Groom to_groom(std::span<const Strand> strands, float thickness, const char* info);

}  // namespace vellus::sculpt
