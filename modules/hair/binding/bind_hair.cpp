#include "modules/hair/binding/bind_hair.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/platform/log.h"
#include "modules/hair/binding/bind_roots.h"
#include "modules/hair/binding/bound_roots.h"
#include "modules/hair/binding/components.h"
#include "modules/hair/binding/rest_target.h"
#include "modules/hair/components.h"
#include "modules/scene/transform.h"

namespace vellus::hair {

namespace {

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
Result<void> bind(World& world, gpu::Device* device, Entity hair, Entity mesh,
                  const RestTarget& target, const glm::dmat4& placement) {
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
    auto target = find_rest_target(world, mesh);
    if (!target) return target.error();
    return bind(world, device, hair, mesh, *target, placement_at_rest(world, *target, hair));
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
    auto target = find_rest_target(world, mesh);
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
