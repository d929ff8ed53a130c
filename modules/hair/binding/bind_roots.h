#pragma once

#include "modules/hair/binding/rest_mesh.h"

namespace vellus::hair {

/// Strands to bind: points of all, root to tip; strand s is [strand_begin[s], strand_begin[s + 1]).
struct StrandShape {
    std::span<const glm::vec3> positions;
    std::span<const uint32_t> strand_begin;
};

/// Finds the nearest point of the mesh for each root and puts the strand into the frame there, on
/// all cores. `placement` takes the groom to the mesh's rest space. Roots off the skin keep their
/// distance. Errors: a mesh whose triangles all have no area.
Result<BoundRoots> bind_roots(const StrandShape& strands, const glm::dmat4& placement,
                              const RestMesh& mesh);

}  // namespace vellus::hair
