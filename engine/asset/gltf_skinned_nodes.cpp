#include <algorithm>

#include "engine/asset/gltf_context.h"

namespace vellus::asset::detail {
namespace {

struct MeshJoints {
    bool skinned = false;
    bool partly = false;
    uint32_t largest = 0;
};

MeshJoints joints_of(const Mesh& mesh) {
    MeshJoints result;
    for (const Primitive& primitive : mesh.primitives) {
        result.skinned |= !primitive.joints.empty();
        result.partly |= primitive.joints.empty();
        for (const glm::u16vec4& joints : primitive.joints) {
            result.largest = std::max({result.largest, uint32_t{joints.x}, uint32_t{joints.y},
                                       uint32_t{joints.z}, uint32_t{joints.w}});
        }
    }
    return result;
}

uint32_t root_of(uint32_t node, const SceneAsset& scene) {
    while (scene.nodes[node].parent != kNone) {
        node = scene.nodes[node].parent;
    }
    return node;
}

void check_skin_roots(const Skin& skin, const std::string& pointer, Context& context,
                      const SceneAsset& scene) {
    const uint32_t root = root_of(skin.joints.front(), scene);
    bool shared = true;
    for (const uint32_t joint : skin.joints) {
        shared &= root_of(joint, scene) == root;
    }
    if (!shared) {
        context.warn(pointer, "the joints have no common root");
    } else if (std::find(scene.roots.begin(), scene.roots.end(), root) == scene.roots.end()) {
        context.warn(pointer, "the joints are not part of the scene");
    }
}

}  // namespace

void check_skinned_nodes(Context& context, const SceneAsset& scene) {
    std::vector<MeshJoints> meshes;
    for (const Mesh& mesh : scene.meshes) {
        meshes.push_back(joints_of(mesh));
    }
    for (size_t s = 0; s < scene.skins.size(); ++s) {
        check_skin_roots(scene.skins[s], fmt::format("/skins/{}", s), context, scene);
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const std::string pointer = fmt::format("/nodes/{}", i);
        if (node.skin == kNone) {
            if (node.mesh != kNone && meshes[node.mesh].skinned) {
                context.warn(pointer, "a skinned mesh without a skin");
            }
            continue;
        }
        if (node.mesh == kNone) {
            context.warn(pointer + "/skin", "a skin without a mesh");
            continue;
        }
        const MeshJoints& mesh = meshes[node.mesh];
        if (mesh.partly) {
            context.warn(pointer + "/skin", "the mesh has primitives without joints");
        }
        if (mesh.skinned && mesh.largest >= scene.skins[node.skin].joints.size()) {
            refuse(pointer + "/mesh",
                   fmt::format("its vertices use joint {}, but skin {} has {}", mesh.largest,
                               node.skin, scene.skins[node.skin].joints.size()),
                   "export it again");
        }
    }
}

}  // namespace vellus::asset::detail
