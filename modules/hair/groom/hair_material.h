#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace vellus::hair {

/// What a groom's strands are made of: plain parameters, colours linear.
struct HairMaterial {
    /// Colour at the root (and all along, unless tip_color differs); each channel in [0, 1].
    glm::vec3 base_color{0.36f, 0.19f, 0.09f};
    /// Colour at the tip; each channel in [0, 1].
    glm::vec3 tip_color{0.36f, 0.19f, 0.09f};
    /// Where along the strand the change from base_color to tip_color begins, in [0, 1).
    float gradient_start = 0.0f;
    /// Spread of brightness between strands, in [0, 1]: a strand's colour is scaled by 1 +- this.
    float color_variation = 0.1f;
    /// Multiply by the groom's own colours, where it has them.
    bool use_groom_colors = true;

    /// Strength of the surface reflection, in [0, 1]; 0.5 is a hair's index of refraction, 1.55.
    float specular = 0.5f;
    /// Longitudinal roughness, in [0.05, 1].
    float roughness = 0.3f;
    /// Strength of the multiple-scattering term, in [0, 1].
    float scatter = 1.0f;
    /// Tilt of the cuticle scales in radians, in [-0.2, 0.2]; two degrees in human hair.
    float shift = 0.035f;
    /// Opacity of a strand, in [0, 1].
    float alpha = 1.0f;
};

/// Strand diameter in metres at root and tip; each in (0, 0.05]. Zero root: taken from the groom.
struct HairWidth {
    float root = 0.0f;
    /// Fraction of the root's width that is left at the tip, in [0, 1].
    float tip_scale = 0.3f;
};

/// Amounts of the two pigments of hair: 0.3 is blond, 1.3 brown, 8 black.
struct Melanin {
    float eumelanin = 1.3f;
    float pheomelanin = 0.0f;
};

/// Colour of hair with these pigments: absorption by d'Eon et al. 2011 (An Energy-Conserving Hair
/// Reflectance Model, 5.1), turned into reflectance by Chiang et al. 2016 eq. 9 at roughness 0.3.
glm::vec3 melanin_color(Melanin melanin);

/// From two sliders in [0, 1] to pigments: amount -ln(1 - melanin), split by redness.
Melanin melanin_from_sliders(float melanin, float redness);

/// Moves every parameter into its range (NaN becomes the default); one line per change, naming the
/// parameter, its value and the range.
std::vector<std::string> clamp_to_ranges(HairMaterial& material);

}  // namespace vellus::hair
