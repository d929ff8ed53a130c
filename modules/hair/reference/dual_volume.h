#pragma once

#include "modules/hair/reference/chiang.h"

namespace vellus::hair::reference {

/// A slab of parallel fibres, thinner than anything and evenly spread: what multiple scattering in
/// hair is apart from its geometry. Fibres run along x, the slab faces z, and a fibre's
/// cross-section makes the optical depth along a direction of inclination θ and azimuth φ (from z)
/// depth / cos φ.
struct FibreSlab {
    ChiangFibre fibre;
    double thickness = 1e9;  ///< in mean free paths along z
};

/// Inclination and azimuth, radians; both directions away from the fibres.
struct SlabDirection {
    double theta = 0.0;
    double phi = 0.0;
};

/// Radiance towards `eye` (|φ| < 90°) under a beam of irradiance 1 from `light`, multiple
/// scattering to any depth, by random walks with next-event estimation; `single` leaves the first
/// scattering only.
glm::dvec3 slab_radiance(const FibreSlab& slab, SlabDirection eye, SlabDirection light, int paths,
                         uint64_t seed, bool single = false);

}  // namespace vellus::hair::reference
