#include "modules/hair/binding/bind_hair.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/platform/log.h"
#include "modules/hair/binding/bind_roots.h"
#include "modules/hair/binding/bound_roots.h"
#include "modules/hair/binding/components.h"
#include "modules/hair/components.h"
#include "modules/scene/transform.h"

namespace vellus::hair {

namespace {

/// Where an entity is in the rest space of an instance: up its parents, from the first node of that
/// instance on by the file's transforms. Without such a node: relative to `space`, an entity, as
/// things are now.
class Placement {
  public:
    Placement(const World& world, uint32_t instance, Entity space)
        : world_(world), instance_(instance), space_(space) {}

    [[nodiscard]] glm::dmat4 of(Entity entity) const {
        const auto& library = world_.resource<scene::SceneLibrary>();
        glm::dmat4 matrix(1.0);
        for (Entity at = entity; at != kNoEntity; at = parent(at)) {
            const auto* ref = world_.get<scene::NodeRef>(at);
            if (ref != nullptr && ref->instance == instance_) {
                const auto& asset = library.asset_of(library.instances[instance_]);
                return rest_transforms(asset)[ref->node] * matrix;
            }
            if (at == space_) return matrix;
            matrix = local(at) * matrix;
        }
        return glm::inverse(now(space_)) * matrix;
    }

  private:
    [[nodiscard]] Entity parent(Entity entity) const {
        const auto* up = world_.get<scene::Parent>(entity);
        return up == nullptr ? kNoEntity : up->entity;
    }
    [[nodiscard]] glm::dmat4 local(Entity entity) const {
        const auto* transform = world_.get<scene::LocalTransform>(entity);
        return transform == nullptr ? glm::dmat4(1.0) : scene::to_matrix(*transform);
    }
    [[nodiscard]] glm::dmat4 now(Entity entity) const {
        glm::dmat4 matrix(1.0);
        for (Entity at = entity; at != kNoEntity; at = parent(at)) matrix = local(at) * matrix;
        return matrix;
    }

    const World& world_;
    uint32_t instance_;
    Entity space_;
};

/// A mesh to bind to, and the entity or instance whose space it rests in.
struct Target {
    const asset::SceneAsset* asset = nullptr;
    uint32_t asset_index = 0;
    uint32_t mesh = 0;  ///< as in BindingKey
    uint32_t instance = asset::kNone;
    Entity space;

    [[nodiscard]] std::string name() const {
        const std::string file = asset->path.string();
        if (mesh >= kMeshItself) {
            return fmt::format("{}: mesh '{}'", file, asset->meshes[mesh - kMeshItself].name);
        }
        return fmt::format("{}: node {} '{}'", file, mesh, asset->nodes[mesh].name);
    }
    [[nodiscard]] Result<RestMesh> at_rest() const {
        if (mesh < kMeshItself) return rest_mesh(*asset, mesh);
        const glm::dmat4 identity(1.0);
        const asset::Mesh& shape = asset->meshes[mesh - kMeshItself];
        return rest_mesh(shape, {&identity, 1}, shape.morph_weights);
    }
};

Result<Target> find_target(World& world, Entity entity) {
    const auto* mesh = world.get<scene::MeshInstance>(entity);
    if (mesh == nullptr) {
        return Error{"the entity has no mesh", "hair binding", "give one with a MeshInstance"};
    }
    const auto& library = world.resource<scene::SceneLibrary>();
    Target target{.asset = library.assets[mesh->asset].get(),
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

/// A place in the list that no entity uses any more, else a new one.
Result<uint32_t> free_place(World& world, gpu::Device* device) {
    auto& list = world.resource<HairBindings>().list;
    std::vector<bool> used(list.size(), false);
    world.query<const HairBinding>().each(
        [&](const HairBinding& binding) { used[binding.roots] = true; });
    const auto place = static_cast<uint32_t>(std::ranges::find(used, false) - used.begin());
    if (place == list.size()) {
        list.emplace_back();
        return place;
    }
    // Frames on their way may still read what lies there.
    if (device != nullptr) {
        if (auto idle = device->wait_idle(); !idle) return idle.error();
    }
    list[place] = {};
    return place;
}

/// Without a device nothing is uploaded.
Result<void> bind(World& world, gpu::Device* device, Entity hair, Entity mesh, const Target& target,
                  const glm::dmat4& placement) {
    const BindingKey key{world.get<Hair>(hair)->groom, target.asset_index, target.mesh, placement};
    auto& list = world.resource<HairBindings>().list;
    const auto known = std::ranges::find_if(list, [&](const BoundGroom& bound) {
        return bound.key == key && (device == nullptr || bound.buffers.vertices);
    });
    if (known != list.end()) {
        world.add(hair,
                  HairBinding{.mesh = mesh, .roots = static_cast<uint32_t>(known - list.begin())});
        return {};
    }
    const LibraryGroom& groom = world.resource<HairLibrary>().grooms[key.groom];
    auto rest = target.at_rest();
    if (!rest) return rest.error();
    auto roots = bind_roots({groom.positions, groom.strand_begin}, placement, *rest);
    if (!roots) {
        Error error = roots.error();
        error.where = target.name();
        return error;
    }
    BoundRootBuffers buffers;
    if (device != nullptr) {
        auto uploaded = BoundRootBuffers::upload(*device, *roots);
        if (!uploaded) return uploaded.error();
        buffers = *std::move(uploaded);
    }
    log_info("{}: {} roots on {}, at most {:.3g} m off its skin", groom.name, roots->roots.size(),
             target.name(), roots->farthest);
    world.remove<HairBinding>(hair);
    auto place = free_place(world, device);
    if (!place) return place.error();
    list[*place] = {key, *std::move(roots), std::move(buffers)};
    world.add(hair, HairBinding{.mesh = mesh, .roots = *place});
    return {};
}

std::string mesh_nodes(const asset::SceneAsset& scene) {
    std::string line;
    size_t named = 0;
    for (size_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh == asset::kNone) continue;
        if (++named > 8) return line + ", ...";
        line += fmt::format("{}{} '{}'", line.empty() ? "" : ", ", node, scene.nodes[node].name);
    }
    return line.empty() ? "the scene has no node with a mesh" : "nodes with a mesh: " + line;
}

Result<void> bind_at_rest(World& world, gpu::Device* device, Entity hair, Entity mesh) {
    if (!world.has<Hair>(hair)) {
        return Error{"the entity has no Hair", "hair binding", "spawn it by spawn_hair"};
    }
    auto target = find_target(world, mesh);
    if (!target) return target.error();
    const Placement placement(world, target->instance, target->space);
    return bind(world, device, hair, mesh, *target, placement.of(hair));
}

}  // namespace

Result<void> bind_hair(World& world, gpu::Device& device, Entity hair, Entity mesh) {
    return bind_at_rest(world, &device, hair, mesh);
}

Result<void> bind_hair(World& world, Entity hair, Entity mesh) {
    return bind_at_rest(world, nullptr, hair, mesh);
}

Result<void> rebind_hair(World& world, gpu::Device& device, Entity hair, Entity mesh,
                         const glm::dmat4& align) {
    const auto* binding = world.get<HairBinding>(hair);
    if (binding == nullptr) {
        return Error{"the hair is not bound yet", "hair binding", "use bind_hair"};
    }
    auto target = find_target(world, mesh);
    if (!target) return target.error();
    const glm::dmat4 placement =
        align * world.resource<HairBindings>().list[binding->roots].roots.placement;
    return bind(world, &device, hair, mesh, *target, placement);
}

bool unbind_hair(World& world, Entity hair) {
    return world.remove<HairBinding>(hair);
}

Result<uint32_t> find_binding_node(const asset::SceneAsset& scene, const HairBindingChoice& choice,
                                   const std::string& where) {
    const std::string field = where + ".binding.mesh";
    if (choice.node) {
        if (*choice.node < scene.nodes.size() && scene.nodes[*choice.node].mesh != asset::kNone) {
            return *choice.node;
        }
        return Error{fmt::format("is {}, {}", *choice.node,
                                 *choice.node < scene.nodes.size() ? "a node without a mesh"
                                                                   : "but there is no such node"),
                     field, mesh_nodes(scene)};
    }
    uint32_t found = asset::kNone;
    for (uint32_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].name != choice.name || scene.nodes[node].mesh == asset::kNone) {
            continue;
        }
        if (found != asset::kNone) {
            return Error{
                fmt::format("is '{}', which nodes {} and {} are called", choice.name, found, node),
                field, "give the node's index instead"};
        }
        found = node;
    }
    if (found != asset::kNone) return found;
    return Error{fmt::format("is '{}', but no node with a mesh is called so", choice.name), field,
                 mesh_nodes(scene)};
}

}  // namespace vellus::hair
