#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "modules/hair/environment/ambient_volume.h"

namespace vellus::hair {

/// What hair around a point of a surface keeps of the sky there, weighted as a matt surface takes
/// it in: see cover_share() of hair/environment/cover.glsl.
struct SkyAtVertex {
    float open = 1.0f;     ///< share that no hair hides
    float depth = 0.0f;    ///< optical depth of hair before the rest
    glm::vec3 lean{0.0f};  ///< what is added to the normal where light arrives from
};

/// A groom on a mesh, and how the space where the mesh rests lies in the groom's.
struct CoveringGroom {
    AmbientVolume volume;
    glm::mat4 to_groom{1.0f};
};

/// A mesh at rest; normals of any length.
struct CoveredSurface {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::uvec3> triangles;
};

struct MeshCover {
    std::vector<SkyAtVertex> vertices;
    std::vector<float> amounts;  ///< by groom: mean optical depth it adds, summed over vertices
};

/// By 64 directions all around, those above the surface. What the mesh itself hides is left out of
/// all means: covers say what hair changes. The mesh becomes the volumes' skin.
MeshCover mesh_cover(const CoveredSurface& surface, std::span<CoveringGroom> grooms);

/// The two numbers from the means of e^(-0.3 d) and e^(-d) over the depths d of directions: exact
/// at these two, and the shares of a mean that is all open or all of one depth.
SkyAtVertex fit_sky(float mean_light, float mean_dark);

}  // namespace vellus::hair
