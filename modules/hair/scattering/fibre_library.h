#pragma once

#include <vector>

#include "modules/hair/groom/hair_material.h"
#include "modules/hair/scattering/fibre.h"
#include "modules/hair/techniques.h"

namespace vellus::hair {

/// The optics of this material: its index, and Karis's azimuthal widths times its factor.
FibreOptics fibre_optics(const HairMaterial& material);

/// Whether shading by these techniques reads a HairFibre; the others have none made.
bool needs_fibre(ScatteringTechnique scattering, MultipleTechnique multiple,
                 EnvironmentTechnique environment = EnvironmentTechnique::kNone);

/// Azimuthal fits made so far, one for each set of optics in use; the oldest goes when there are
/// many. Resource.
class FibreLibrary {
  public:
    /// With the longitudinal lobes of this roughness and shift (sine). Fits only on the first call
    /// for these optics.
    glsl::HairFibre fibre(const FibreOptics& optics, float roughness, float shift);
    /// Fits made so far: constant in steady frames.
    [[nodiscard]] size_t fitted() const { return fitted_; }

  private:
    struct Entry {
        FibreOptics optics;
        glsl::HairFibre fibre;
    };
    std::vector<Entry> entries_;
    size_t fitted_ = 0;
};

}  // namespace vellus::hair
