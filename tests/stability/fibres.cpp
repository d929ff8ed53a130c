#include <cstring>

#include "modules/hair/scattering/fibre.h"
#include "tests/stability/shading_functions.h"

namespace vellus::test {

namespace {

constexpr std::array<hair::FibreOptics, kFibres> kOptics = {
    {{}, {1.1f, 0.3f, 0.14f}, {3.0f, 1.3f, 0.55f}, {1.33f, 0.63f, 0.27f}}};

const std::array<hair::glsl::HairFibre, kFibres>& fitted() {
    static const auto fibres = [] {
        std::array<hair::glsl::HairFibre, kFibres> all{};
        for (size_t i = 0; i < all.size(); ++i) hair::fit_azimuthal(kOptics[i], all[i]);
        return all;
    }();
    return fibres;
}

}  // namespace

FibreFloats fibre_floats(size_t fibre, float roughness, float shift) {
    hair::glsl::HairFibre made = fitted()[fibre];
    hair::set_longitudinal(roughness, shift, made);
    FibreFloats floats;
    static_assert(sizeof(made) == sizeof(floats));
    std::memcpy(floats.data(), &made, sizeof(made));
    return floats;
}

}  // namespace vellus::test
