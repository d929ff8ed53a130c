#pragma once

#include "modules/hair/reference/fibre.h"

namespace vellus::hair::reference {

/// Zinke, Yuksel, Weber, Keyser 2008, "Dual Scattering Approximation for Fast Multiple Scattering
/// in Hair": what a fibre does on average to light of one inclination that has no preferred
/// azimuth.
struct DualAverages {
    double forward = 0.0;   ///< a_f: share of the light that goes on into the front half
    double backward = 0.0;  ///< a_b: share that turns back; a_f + a_b is the albedo
    double forward_tilt = 0.0, backward_tilt = 0.0;          ///< mean turn along the fibre, radians
    double forward_variance = 0.0, backward_variance = 0.0;  ///< of that turn, radians²
};

/// Eq. 6 and 11-14 at the *incoming* inclination θi, single scattering of deon.h. Averaging over
/// the azimuth of the light in front of a half plane weighs a relative azimuth φ with |φ|/π
/// (forward) and 1 - |φ|/π (backward).
DualAverages dual_averages(const Fibre& fibre, double theta_i);

/// Reflectance of a half space of layers that each pass `forward` and turn back `backward`, all
/// orders: the smaller root of b R² - (1 + b² - f²) R + b = 0. Needs forward + backward <= 1.
double half_space_reflectance(double forward, double backward);

/// A_b with all orders: the half space behind one fibre less its own first reflection, R∞ - a_b.
double backscatter_all_orders(double forward, double backward);

/// Zinke's A_1 (eq. 14) and A_3 (eq. 17), one and three backward scatterings; forward < 1.
double backscatter_one(double forward, double backward);
double backscatter_three(double forward, double backward);

/// Eq. 21: mean turn of backscattered light; eq. 22: its deviation with 3 β_b² under the second
/// root and density factor d_b.
double backscatter_tilt(const DualAverages& a);
double backscatter_deviation(const DualAverages& a, double density);

}  // namespace vellus::hair::reference
