#pragma once

#include <string>

#include "engine/ecs/ecs.h"
#include "engine/gpu/device.h"
#include "engine/platform/result.h"
#include "modules/hair/groom/hair_extension.h"
#include "modules/scene/library.h"

namespace vellus::hair {

/// Binds the roots of a hair entity to the mesh of another entity, both as their scene's file has
/// them at rest; gives `hair` a HairBinding, in place of one it has. `mesh` needs a MeshInstance
/// (and a NodeRef where it is skinned). Entities with the same groom at the same place of the
/// same mesh share their binding's memory. Errors name the mesh and
/// leave `hair` as it was.
Result<void> bind_hair(World& world, gpu::Device& device, Entity hair, Entity mesh);
/// The same for worlds without a device: only the columns.
Result<void> bind_hair(World& world, Entity hair, Entity mesh);

/// Moves a bound groom to another mesh of the same shape, whatever its vertices, triangles,
/// skeleton or place: the roots keep the places they had in the rest space of the old one. `align`
/// takes that space to the new mesh's. Errors: not bound, and those of bind_hair.
Result<void> rebind_hair(World& world, gpu::Device& device, Entity hair, Entity mesh,
                         const glm::dmat4& align = glm::dmat4(1.0));

/// From now on the groom moves rigidly with its own node; false where it was not bound.
bool unbind_hair(World& world, Entity hair);

/// The node a VELLUS_hair.binding means, or an Error that names the field and what there is.
Result<uint32_t> find_binding_node(const asset::SceneAsset& scene, const HairBindingChoice& choice,
                                   const std::string& where);

}  // namespace vellus::hair
