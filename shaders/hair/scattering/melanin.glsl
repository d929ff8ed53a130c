// Base colour of a fibre from its pigments.
#ifndef VELLUS_HAIR_MELANIN_GLSL
#define VELLUS_HAIR_MELANIN_GLSL
#include "common/portable.glsl"

/// Absorption σ_a per fibre radius for concentrations >= 0 (eumelanin: blond 0.3, brown 1.3, black 8).
/// Source: d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model", §6.1, in linear RGB.
VELLUS_FN vec3 melanin_absorption(float eumelanin, float pheomelanin) {
    return eumelanin * vec3(0.419f, 0.697f, 1.37f) + pheomelanin * vec3(0.187f, 0.4f, 1.05f);
}

/// C such that Karis's absorption is that of the fibre: TT at h = 0, θd = 0 is C^½ = e^(-2 σ_a), the
/// diameter's Beer-Lambert transmittance. TRT agrees: e^(-4 σ_a cos γt) = C^0.83 there (slides: 0.8).
/// (Chiang et al. 2016 invert the reflectance of a whole head under their fibre: another quantity.)
VELLUS_FN vec3 absorption_to_base_color(vec3 sigma_a) { return exp(-4.0f * sigma_a); }

VELLUS_FN vec3 melanin_base_color(float eumelanin, float pheomelanin) {
    return absorption_to_base_color(melanin_absorption(eumelanin, pheomelanin));
}

#endif
