#include "modules/hair/reference/longitudinal.h"

#include <cmath>
#include <numbers>

namespace vellus::hair::reference {

double bessel_i0e(double x) {
    if (x < 40.0) {
        const double quarter = 0.25 * x * x;
        double term = std::exp(-x);
        double sum = term;
        for (int k = 1; term > 1e-18 * sum || k < x; ++k) {
            term *= quarter / (static_cast<double>(k) * k);
            sum += term;
        }
        return sum;
    }
    double term = 1.0;
    double sum = 1.0;
    for (int k = 1; k <= 12; ++k) {
        term *= (2.0 * k - 1.0) * (2.0 * k - 1.0) / (8.0 * k * x);
        sum += term;
    }
    return sum / std::sqrt(2.0 * std::numbers::pi * x);
}

double longitudinal_gaussian(double beta, double sin_sum, double alpha) {
    const double x = (sin_sum - alpha) / beta;
    return std::exp(-0.5 * x * x) / (beta * std::sqrt(2.0 * std::numbers::pi));
}

double longitudinal_gaussian_energy(double beta, double sin_r) {
    const double scale = 1.0 / (beta * std::numbers::sqrt2);
    return 0.5 * (std::erf((1.0 - sin_r) * scale) + std::erf((1.0 + sin_r) * scale));
}

double longitudinal_deon(double v, double theta_i, double theta_r) {
    return longitudinal_deon(v, {std::sin(theta_i), std::cos(theta_i)},
                             {std::sin(theta_r), std::cos(theta_r)});
}

double longitudinal_deon(double v, Inclination i, Inclination r) {
    const double ci = std::abs(i.cos);
    const double cr = std::abs(r.cos);
    const double across = ci - cr;
    const double along = i.sin + r.sin;
    return bessel_i0e(ci * cr / v) * std::exp(-0.5 * (across * across + along * along) / v) /
           (v * -std::expm1(-2.0 / v));
}

}  // namespace vellus::hair::reference
