#include "modules/scene/instantiate.h"

#include <fmt/format.h>

#include <algorithm>

namespace vellus::scene {
namespace {

using asset::kNone;
using asset::SceneAsset;

Error invalid(const SceneAsset& scene, std::string what) {
    return {std::move(what), scene.path.string(),
            "the file is not valid glTF 2.0; export it again"};
}

Error out_of_range(const SceneAsset& scene, const std::string& field, uint32_t index,
                   size_t count) {
    return invalid(scene, fmt::format("{} is {}, but there are {}", field, index, count));
}

Result<void> check_references(const SceneAsset& scene) {
    const auto bad = [](uint32_t index, size_t count) { return index != kNone && index >= count; };
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const asset::Node& node = scene.nodes[i];
        const auto field = [&](const char* name) { return fmt::format("/nodes/{}/{}", i, name); };
        if (bad(node.mesh, scene.meshes.size())) {
            return out_of_range(scene, field("mesh"), node.mesh, scene.meshes.size());
        }
        if (bad(node.skin, scene.skins.size())) {
            return out_of_range(scene, field("skin"), node.skin, scene.skins.size());
        }
        if (bad(node.camera, scene.cameras.size())) {
            return out_of_range(scene, field("camera"), node.camera, scene.cameras.size());
        }
        if (bad(node.light, scene.lights.size())) {
            return out_of_range(scene, field("extensions/KHR_lights_punctual/light"), node.light,
                                scene.lights.size());
        }
    }
    for (size_t i = 0; i < scene.skins.size(); ++i) {
        const asset::Skin& skin = scene.skins[i];
        for (const uint32_t joint : skin.joints) {
            if (joint >= scene.nodes.size()) {
                return out_of_range(scene, fmt::format("/skins/{}/joints", i), joint,
                                    scene.nodes.size());
            }
        }
        if (!skin.inverse_bind.empty() && skin.inverse_bind.size() < skin.joints.size()) {
            return invalid(scene, fmt::format("/skins/{}/inverseBindMatrices: {} for {} joints", i,
                                              skin.inverse_bind.size(), skin.joints.size()));
        }
    }
    return {};
}

/// Nodes below the roots, parents first, with their parents; refuses all that is not a forest.
struct NodeOrder {
    std::vector<uint32_t> nodes;
    std::vector<uint32_t> parent;  // by node index
};

Result<NodeOrder> order_nodes(const SceneAsset& scene) {
    NodeOrder order;
    order.parent.assign(scene.nodes.size(), kNone);
    std::vector<bool> reached(scene.nodes.size(), false);
    const auto reach = [&](uint32_t node, const std::string& field) -> Result<void> {
        if (node >= scene.nodes.size()) {
            return out_of_range(scene, field, node, scene.nodes.size());
        }
        if (reached[node]) {
            return invalid(scene, fmt::format("{}: node {} has two parents or is its own ancestor",
                                              field, node));
        }
        reached[node] = true;
        order.nodes.push_back(node);
        return {};
    };
    for (const uint32_t root : scene.roots) {
        if (auto ok = reach(root, "/scenes/nodes"); !ok) return ok.error();
    }
    for (size_t i = 0; i < order.nodes.size(); ++i) {
        const uint32_t parent = order.nodes[i];
        for (const uint32_t child : scene.nodes[parent].children) {
            if (auto ok = reach(child, fmt::format("/nodes/{}/children", parent)); !ok) {
                return ok.error();
            }
            order.parent[child] = parent;
        }
    }
    return order;
}

void add_contents(World& world, Entity entity, const SceneAsset& scene, uint32_t asset_index,
                  const asset::Node& node) {
    if (node.mesh != kNone) world.add(entity, MeshInstance{asset_index, node.mesh, node.skin});
    if (node.camera != kNone && scene.cameras[node.camera].perspective) {
        const asset::Camera& camera = scene.cameras[node.camera];
        world.add(entity, Camera{camera.vertical_fov, camera.near_plane});
    }
    if (node.light != kNone) {
        const asset::Light& light = scene.lights[node.light];
        world.add(entity, Light{light.kind, light.color, light.intensity, light.range,
                                light.inner_cone, light.outer_cone});
    }
    if (!node.extensions.empty()) world.add(entity, NodeExtensions{node.extensions});
}

}  // namespace

uint32_t add_asset(World& world, const std::shared_ptr<const SceneAsset>& asset) {
    if (world.find_resource<SceneLibrary>() == nullptr) world.emplace_resource<SceneLibrary>();
    auto& assets = world.resource<SceneLibrary>().assets;
    const auto found = std::find(assets.begin(), assets.end(), asset);
    if (found != assets.end()) return static_cast<uint32_t>(found - assets.begin());
    assets.push_back(asset);
    return static_cast<uint32_t>(assets.size() - 1);
}

Result<uint32_t> instantiate(World& world, const std::shared_ptr<const SceneAsset>& asset,
                             const LocalTransform& place) {
    const SceneAsset& scene = *asset;
    if (auto ok = check_references(scene); !ok) return ok.error();
    const auto order = order_nodes(scene);
    if (!order) return order.error();

    const uint32_t asset_index = add_asset(world, asset);
    auto& library = world.resource<SceneLibrary>();
    const auto index = static_cast<uint32_t>(library.instances.size());
    SceneInstance instance{asset_index, kNoEntity,
                           std::vector<Entity>(scene.nodes.size(), kNoEntity)};
    instance.root = world.spawn(place, WorldTransform{}, PreviousWorldTransform{},
                                Name{scene.path.stem().string()}, InstanceRoot{index});
    for (const uint32_t i : (*order).nodes) {
        const asset::Node& node = scene.nodes[i];
        const uint32_t up = (*order).parent[i];
        const Entity parent = up == kNone ? instance.root : instance.nodes[up];
        instance.nodes[i] =
            world.spawn(LocalTransform{glm::dvec3(node.translation), node.rotation, node.scale},
                        WorldTransform{}, PreviousWorldTransform{}, Parent{parent}, Name{node.name},
                        NodeRef{index, i});
        add_contents(world, instance.nodes[i], scene, asset_index, node);
    }
    library.instances.push_back(std::move(instance));
    return index;
}

Entity spawn_camera(World& world, const CameraPose& pose) {
    return world.spawn(Camera{pose.vertical_fov, pose.near_plane}, local_transform(pose),
                       WorldTransform{}, PreviousWorldTransform{}, ActiveCamera{});
}

}  // namespace vellus::scene
