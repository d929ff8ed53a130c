#include "modules/hair/binding/rest_target.h"

#include <fmt/format.h>

#include "modules/hair/binding/bound_roots.h"
#include "modules/scene/library.h"
#include "modules/scene/transform.h"

namespace vellus::hair {

namespace {

Entity parent(const World& world, Entity entity) {
    const auto* up = world.get<scene::Parent>(entity);
    return up == nullptr ? kNoEntity : up->entity;
}

glm::dmat4 local(const World& world, Entity entity) {
    const auto* transform = world.get<scene::LocalTransform>(entity);
    return transform == nullptr ? glm::dmat4(1.0) : scene::to_matrix(*transform);
}

glm::dmat4 now(const World& world, Entity entity) {
    glm::dmat4 matrix(1.0);
    for (Entity at = entity; at != kNoEntity; at = parent(world, at)) {
        matrix = local(world, at) * matrix;
    }
    return matrix;
}

}  // namespace

std::string RestTarget::name() const {
    const std::string file = asset->path.string();
    if (mesh >= kMeshItself) {
        return fmt::format("{}: mesh '{}'", file, asset->meshes[mesh - kMeshItself].name);
    }
    return fmt::format("{}: node {} '{}'", file, mesh, asset->nodes[mesh].name);
}

std::vector<glm::dmat4> RestTarget::palette() const {
    if (mesh < kMeshItself) return rest_palette(*asset, mesh);
    return {glm::dmat4(1.0)};
}

Result<RestMesh> RestTarget::at_rest() const {
    if (mesh < kMeshItself) return rest_mesh(*asset, mesh);
    const asset::Mesh& shape = asset->meshes[mesh - kMeshItself];
    return rest_mesh(shape, palette(), shape.morph_weights);
}

Result<RestTarget> find_rest_target(const World& world, Entity entity) {
    const auto* mesh = world.get<scene::MeshInstance>(entity);
    if (mesh == nullptr) {
        return Error{"the entity has no mesh", "hair binding", "give one with a MeshInstance"};
    }
    const auto& library = world.resource<scene::SceneLibrary>();
    RestTarget target{.asset = library.assets[mesh->asset].get(),
                      .asset_index = mesh->asset,
                      .mesh = kMeshItself + mesh->mesh,
                      .space = entity};
    if (const auto* ref = world.get<scene::NodeRef>(entity)) {
        target.mesh = ref->node;
        target.instance = ref->instance;
        target.space = library.instances[ref->instance].root;
    }
    return target;
}

glm::dmat4 placement_at_rest(const World& world, const RestTarget& target, Entity entity) {
    glm::dmat4 matrix(1.0);
    for (Entity at = entity; at != kNoEntity; at = parent(world, at)) {
        const auto* ref = world.get<scene::NodeRef>(at);
        if (ref != nullptr && ref->instance == target.instance) {
            return rest_transforms(*target.asset)[ref->node] * matrix;
        }
        if (at == target.space) return matrix;
        matrix = local(world, at) * matrix;
    }
    return glm::inverse(now(world, target.space)) * matrix;
}

}  // namespace vellus::hair
