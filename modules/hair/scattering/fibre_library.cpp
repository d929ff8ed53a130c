#include "modules/hair/scattering/fibre_library.h"

#include <algorithm>

namespace vellus::hair {

namespace {

constexpr size_t kMostFits = 64;

}  // namespace

FibreOptics fibre_optics(const HairMaterial& material) {
    FibreOptics optics;
    optics.eta = material.eta;
    optics.detector_tt *= material.azimuthal;
    optics.detector_trt *= material.azimuthal;
    return optics;
}

bool needs_fibre(ScatteringTechnique scattering, MultipleTechnique multiple,
                 EnvironmentTechnique environment) {
    return (scattering != ScatteringTechnique::kKaris &&
            scattering != ScatteringTechnique::kKajiyaKay) ||
           multiple == MultipleTechnique::kDual || environment == EnvironmentTechnique::kShDepth;
}

glsl::HairFibre FibreLibrary::fibre(const FibreOptics& optics, float roughness, float shift) {
    auto found = std::ranges::find(entries_, optics, &Entry::optics);
    if (found == entries_.end()) {
        if (entries_.size() == kMostFits) entries_.erase(entries_.begin());
        Entry entry{.optics = optics, .fibre = {}};
        fit_azimuthal(optics, entry.fibre);
        entries_.push_back(entry);
        found = entries_.end() - 1;
        ++fitted_;
    }
    glsl::HairFibre fibre = found->fibre;
    set_longitudinal(roughness, shift, fibre);
    return fibre;
}

}  // namespace vellus::hair
