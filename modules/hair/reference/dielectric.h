#pragma once

namespace vellus::hair::reference {

/// Unpolarised reflectance of a dielectric of relative index `eta` > 1, seen from outside at
/// `cosine` in [0, 1] (Fresnel).
double fresnel_dielectric(double cosine, double eta);

}  // namespace vellus::hair::reference
