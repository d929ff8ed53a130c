#pragma once

#include <vector>

#include "modules/hair/reference/fibre.h"

namespace vellus::hair::reference {

/// d'Eon, Francois, Hill, Letteri, Aubry 2011, "An Energy-Conserving Hair Reflectance Model", by
/// numerical integration. S = Σ M_p N_p [1/sr] with ∫ M_p cos θi dθi = 1 and ∫ N_p dφ = ½ ∫ A(p, h)
/// dh: the fibre's cosine is in M, so that ∫ S dω_i is the albedo. Symmetric in θi and θr where the
/// lobes are not tilted. R has no detector here: its N is closed, ¼ |cos φ/2| F.

/// M_p(θi, θr - tilt).
double deon_longitudinal(const Fibre& fibre, int p, double theta_i, double theta_r);

/// N_p by Gauss-Legendre in γi = asin h, where the integrand is smooth; for p >= 1 and
/// azimuthal[p] >= 0.01 the relative error of the lobe's energy is below 1e-12.
double deon_azimuthal(const Fibre& fibre, int p, double theta_d, double phi);

/// c_k of N_p = c_0 + 2 Σ c_k cos kφ, k < count, p >= 1: c_k = e^(-k²b²/2) / 2π · ½ ∫ A cos kΦ dh.
std::vector<double> deon_azimuthal_series(const Fibre& fibre, int p, double theta_d, int count);

/// c_0 + 2 Σ c_k cos kφ.
double cosine_sum(const std::vector<double>& series, double phi);

/// S of R + TT + TRT.
double deon(const Fibre& fibre, double theta_i, double theta_r, double phi);

/// ∫ S dω_i at θr: the white furnace where absorption is 0. The azimuth integrates in closed form.
double deon_furnace(const Fibre& fibre, double theta_r);

}  // namespace vellus::hair::reference
