#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace vellus::hair::reference {

/// Nodes in (-1, 1) and weights of the Gauss-Legendre rule of `count` points, exact for polynomials
/// of degree 2 count - 1. Made once per count.
struct GaussRule {
    std::vector<double> node;
    std::vector<double> weight;
};
const GaussRule& gauss_rule(int count);

/// ∫ f over [low, high] by one Gauss-Legendre rule: spectrally accurate for analytic f.
template <class F>
double integrate_gauss(double low, double high, int count, const F& f) {
    const GaussRule& rule = gauss_rule(count);
    const double half = 0.5 * (high - low);
    double sum = 0.0;
    for (size_t i = 0; i < rule.node.size(); ++i) {
        sum += rule.weight[i] * f(low + half * (1.0 + rule.node[i]));
    }
    return sum * half;
}

/// ∫ f over [low, high] by the tanh-sinh rule (Takahasi and Mori 1974) with `steps` points on
/// either side of the middle: takes integrable singularities at both ends. `f(x, from_low,
/// from_high)` gets its distances from the ends too, which stay exact where x rounds.
template <class F>
double integrate_tanh_sinh(double low, double high, int steps, const F& f) {
    constexpr double kReach = 3.6;  // e^(-π/2 sinh 3.6) = 3e-13 of the interval
    const double step = kReach / steps;
    const double length = high - low;
    double sum = 0.0;
    for (int k = -steps; k <= steps; ++k) {
        const double t = step * k;
        const double u = 0.5 * std::numbers::pi * std::sinh(t);
        const double slope = 0.5 * std::numbers::pi * std::cosh(t) / (std::cosh(u) * std::cosh(u));
        const double from_low = length / (1.0 + std::exp(-2.0 * u));
        const double from_high = length / (1.0 + std::exp(2.0 * u));
        sum += slope *
               f(from_low < from_high ? low + from_low : high - from_high, from_low, from_high);
    }
    return sum * step * 0.5 * length;
}

/// ∫ f over one period from `low` by the trapezoid rule: spectrally accurate for smooth periodic f.
template <class F>
double integrate_periodic(double low, double period, int count, const F& f) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += f(low + period * i / count);
    return sum * period / count;
}

/// Gauss-Kronrod pair of 7 and 15 points (Kronrod 1965; QUADPACK's dqk15) on [low, high]: the
/// integral and the difference between the two rules.
template <class F>
std::array<double, 2> kronrod_step(double low, double high, const F& f) {
    constexpr std::array<double, 8> kNode = {
        0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
        0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
        0.586087235467691130294144691258379, 0.405845151377397166906606412076961,
        0.207784955007898467600689403773245, 0.0};
    constexpr std::array<double, 8> kWeight = {
        0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
        0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
        0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
        0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
    constexpr std::array<double, 4> kGauss = {
        0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
        0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
    const double half = 0.5 * (high - low);
    const double middle = 0.5 * (high + low);
    double fine = kWeight[7] * f(middle);
    double coarse = kGauss[3] * f(middle);
    for (size_t i = 0; i < 7; ++i) {
        const double pair = f(middle - half * kNode[i]) + f(middle + half * kNode[i]);
        fine += kWeight[i] * pair;
        if (i % 2 == 1) coarse += kGauss[i / 2] * pair;
    }
    return {fine * half, std::abs(fine - coarse) * std::abs(half)};
}

/// ∫ f over [low, high], adaptive: intervals are halved until the two rules of each agree within
/// their share of the absolute `tolerance`, at most `depth` times.
template <class F>
double integrate_adaptive(double low, double high, double tolerance, const F& f, int depth = 40) {
    const auto [value, error] = kronrod_step(low, high, f);
    if (error <= tolerance || depth == 0) return value;
    const double middle = 0.5 * (low + high);
    return integrate_adaptive(low, middle, 0.5 * tolerance, f, depth - 1) +
           integrate_adaptive(middle, high, 0.5 * tolerance, f, depth - 1);
}

}  // namespace vellus::hair::reference
