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
    /// Where the groom has colours of its own they replace base_color and tip_color.
    bool use_groom_colors = true;

    /// Factor on the surface reflection, in [0, 4]; 1 is physical.
    float specular = 1.0f;
    /// Perceptual roughness along the strand, in [0, 1].
    float roughness = 0.3f;
    /// Factor on the multiple-scattering term, in [0, 4].
    float scatter = 1.0f;
    /// Tilt of the cuticle scales in radians, in [-0.2, 0.2]; two degrees in human hair.
    float shift = 0.035f;
    /// Opacity of a strand, in [0, 1].
    float alpha = 1.0f;
    /// Index of refraction, in [1.1, 3]; Karis's fits hold at 1.55 only.
    float eta = 1.55f;
    /// Factor on Karis's azimuthal widths, in [0.5, 2]; his fits hold at 1 only.
    float azimuthal = 1.0f;
};

/// Diameter of a strand and its taper.
struct HairWidth {
    /// Metres, in [0, 0.05]; 0: the groom's own (its thickness, or default_width()).
    float root = 0.0f;
    /// Fraction of that diameter which is left at the tip, in [0, 1].
    float tip_scale = 0.3f;
};

/// Amounts of the two pigments of hair: 0.3 is blond, 1.3 brown, 8 black.
struct Melanin {
    float eumelanin = 1.3f;
    float pheomelanin = 0.0f;
};

/// Base colour of hair with these pigments (hair/scattering/melanin.glsl), each in [0, 100].
glm::vec3 melanin_color(Melanin melanin);

/// From two sliders in [0, 1] to pigments: amount -ln(1 - melanin), at most 9.2, split by redness;
/// the artist controls of Unreal's and Cycles' hair.
Melanin melanin_from_sliders(float melanin, float redness);

/// Moves every parameter into its range (NaN becomes the default); one line per change, naming the
/// parameter, its value and the range.
std::vector<std::string> clamp_to_ranges(HairMaterial& material);

}  // namespace vellus::hair
