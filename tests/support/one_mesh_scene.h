#pragma once

#include <memory>
#include <string>
#include <utility>

#include "engine/asset/scene_asset.h"

namespace vellus::test {

/// A scene of one node with one mesh of one primitive, its material rough and coloured.
inline std::shared_ptr<asset::SceneAsset> one_mesh_scene(const std::string& name,
                                                         asset::Primitive primitive) {
    auto scene = std::make_shared<asset::SceneAsset>();
    scene->path = name + ".gltf";
    primitive.material = 0;
    scene->meshes.push_back({name, {std::move(primitive)}, {}});
    scene->materials.resize(1);
    scene->materials[0].base_color = {0.8f, 0.4f, 0.2f, 1.0f};
    scene->materials[0].metallic = 0.0f;
    scene->materials[0].roughness = 0.7f;
    scene->nodes.resize(1);
    scene->nodes[0].mesh = 0;
    scene->roots = {0};
    return scene;
}

}  // namespace vellus::test
