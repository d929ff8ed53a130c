#pragma once

#include <vector>

#include "assets/generator/part.h"

namespace vellus::sculpt {

/// How skin, shirt, trousers and shoes are sculpted, in this order.
std::vector<PartRecipe> figure_recipes(bool far_away);

/// The parts of all recipes, then the eyes: about 11,000 triangles, or half as many for a figure
/// further away.
std::vector<SkinnedPart> make_figure(bool far_away);

}  // namespace vellus::sculpt
