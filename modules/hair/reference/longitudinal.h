#pragma once

namespace vellus::hair::reference {

/// e^(-x) I0(x) for x >= 0: power series below 40, asymptotic series above. Relative error below
/// 1e-13.
double bessel_i0e(double x);

/// Karis's longitudinal lobe (slides, "Longitudinal scattering function"): a Gaussian of standard
/// deviation `beta` > 0 in sin θi + sin θr - alpha. Normalised over sin θi on the whole line.
double longitudinal_gaussian(double beta, double sin_sum, double alpha);

/// What longitudinal_gaussian(alpha = 0) integrates to over cos θi dθi: it loses what falls past
/// ±90°.
double longitudinal_gaussian_energy(double beta, double sin_r);

/// d'Eon et al. 2011 eq. 7, M of variance `v` > 0, in the form that cannot overflow: I0e(x)
/// e^(-d²/2v) / (v (1 - e^(-2/v))), x = cos θi cos θr / v, d² = (cos θi - cos θr)² + (sin θi + sin
/// θr)². Integrates to 1 over cos θi dθi. I0 is even: an inclination turned past 90° counts
/// with |cos|.
double longitudinal_deon(double v, double theta_i, double theta_r);

/// Sine and cosine (>= 0) of an inclination.
struct Inclination {
    double sin = 0.0;
    double cos = 1.0;
};

/// The same without inverse trigonometry.
double longitudinal_deon(double v, Inclination i, Inclination r);

}  // namespace vellus::hair::reference
