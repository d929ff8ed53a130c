#pragma once

#include <array>

#include "modules/hair/scattering/karis.h"

namespace vellus::hair::reference {

/// A smooth circular dielectric cylinder at one wavelength, and how rough its lobes R, TT, TRT are.
/// Inclinations θ are measured from the normal plane, azimuths φ = 0 scatters back, π goes through.
struct Fibre {
    double eta = 1.55;
    double absorption = 0.0;  ///< σ_a per fibre radius, >= 0
    /// Standard deviation of each lobe along the fibre, and of the azimuthal detector (0: none).
    std::array<double, 3> beta{0.09, 0.045, 0.18};
    std::array<double, 3> azimuthal{0.0, 0.5, 0.25};
    /// Angle by which each lobe is turned along the fibre, radians.
    std::array<double, 3> tilt{0.0, 0.0, 0.0};
    double reflection = 1.0;  ///< factor on R, 1 is physical
};

/// Standard deviations of the detectors behind Karis's distributions: logistics of scale 0.35 (TT)
/// and 0.15 (TRT), deviation π scale / √3.
constexpr double kKarisAzimuthalTt = 0.63481;
constexpr double kKarisAzimuthalTrt = 0.27207;

/// The fibre that Karis's parameters stand for, one colour channel: widths r², r²/2, 2 r², turned
/// by -2, 1, 4 times the tilt of the cuticle, absorption from C = e^(-4 σ_a), his azimuthal widths.
Fibre karis_fibre(const glsl::HairSurface& surface, int channel);

/// η' = √(η² - sin² θd) / cos θd: the index of the normal plane's optics (Bravais).
double modified_index(double eta, double theta_d);

/// Azimuth Φ(p, h) of the p-th path that entered at offset h in [-1, 1]: 2pγt - 2γi + pπ.
double exit_azimuth(int p, double modified, double h);

/// A(p, h): Fresnel factors and Beer-Lambert absorption of that path. d'Eon et al. 2011, eq. 12-14,
/// with the chord 2 cos γt and f = F(η, cos θd cos γi), exact on a cylinder.
double path_attenuation(const Fibre& fibre, int p, double theta_d, double h);

/// ½ ∫ A(p, h) dh = ∫ N_p dφ.
double lobe_attenuation(const Fibre& fibre, int p, double theta_d);

/// Gaussian detector of deviation `width` > 0 on the circle: Σ_k g(φ - 2πk).
double wrapped_gaussian(double phi, double width);

}  // namespace vellus::hair::reference
