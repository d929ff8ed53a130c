#pragma once

#include "modules/hair/techniques.h"

namespace lambert {

/// Makes "lambert" a technique of the scattering axis; later calls return the same.
vellus::Result<vellus::hair::ScatteringTechnique> register_lambert();

}  // namespace lambert
