#pragma once

#include <vector>

#include "engine/gpu/buffer.h"
#include "modules/character/components.h"
#include "modules/hair/components.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/hair/scattering/fibre_library.h"
#include "modules/scene/render_frame.h"

namespace vellus::hair {

/// On hair that the meshes it grows on know of, with this groom.
struct CoversMeshes {
    uint32_t groom = 0;
};

/// A groom as it lies on a resting mesh.
struct CoverPart {
    uint32_t groom = 0;         ///< of the HairLibrary
    glm::dmat4 placement{1.0};  ///< groom to the mesh's rest space
    float tip_scale = 1.0f;

    bool operator==(const CoverPart&) const = default;
};

/// What grooms keep from the vertices of a mesh; entities with the same ones share it.
struct Cover {
    uint32_t asset = 0;  ///< of the SceneLibrary
    uint32_t mesh = 0;   ///< as in BindingKey
    std::vector<CoverPart> parts;
    std::vector<float> amounts;  ///< by part, see MeshCover
    uint64_t primitives = 0;     ///< as in character::SkyCover
    gpu::Buffer vertices;        ///< character::CoveredVertex; empty where no vertex is covered
};

/// A mesh below hair.
struct MeshBelow {
    Entity mesh;
    std::vector<Entity> hair;  ///< by part of the cover
    size_t cover = 0;          ///< into HairCovers::covers
};

/// What hair covers. Resource; covers stay, as frames on their way may read them.
struct HairCovers {
    std::vector<Cover> covers;
    std::vector<MeshBelow> meshes;
};

using WornHairQuery = Query<const Hair, const HairTechniques, const HairMaterial,
                            const scene::WorldBounds, const CoversMeshes*>;
using CoveringHairQuery = Query<const Hair, const HairTechniques, const HairMaterial,
                                const HairWidth, const scene::WorldTransform>;

/// System, stage gather: where hair with environment=sh_depth is in view for the first time, gives
/// a SkyCover to the mesh it is bound to and to those of the same skin; where it is not bound, to
/// the meshes of its scene that move with the same joint.
void cover_meshes(WornHairQuery hair, Res<const scene::ViewState> view, Commands& commands);

/// System, after cover_meshes: the colour of the hair on each mesh, and how much of it there is.
void update_sky_covers(CoveringHairQuery hair, Query<character::SkyCover> covers,
                       Res<const HairCovers> known, Res<const HairLibrary> library,
                       Res<FibreLibrary> fibres);

}  // namespace vellus::hair
