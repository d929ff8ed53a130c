#include "lambert/lambert.h"

#include "lambert_shaders.h"

namespace lambert {

vellus::Result<vellus::hair::ScatteringTechnique> register_lambert() {
    static const auto technique =
        vellus::hair::add_scattering("lambert", vellus::gpu::lambert_shaders().front());
    return technique;
}

}  // namespace lambert
