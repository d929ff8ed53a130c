#include "modules/hair/reference/dielectric.h"

#include <algorithm>
#include <cmath>

namespace vellus::hair::reference {

double fresnel_dielectric(double cosine, double eta) {
    const double c = std::clamp(cosine, 0.0, 1.0);
    const double cos_t = std::sqrt(1.0 - (1.0 - c * c) / (eta * eta));
    const double parallel = (eta * c - cos_t) / (eta * c + cos_t);
    const double across = (c - eta * cos_t) / (c + eta * cos_t);
    return 0.5 * (parallel * parallel + across * across);
}

}  // namespace vellus::hair::reference
