#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/asset/scene_asset.h"
#include "engine/ecs/entity.h"
#include "modules/scene/components.h"

namespace vellus::scene {

/// One placed copy of a scene: entities by node index; kNoEntity for nodes outside the scene.
struct SceneInstance {
    uint32_t asset = asset::kNone;
    Entity root;
    std::vector<Entity> nodes;
};

/// Loaded scenes and their placed copies. Resource; assets stay as long as it does, so that
/// components may point into them.
struct SceneLibrary {
    std::vector<std::shared_ptr<const asset::SceneAsset>> assets;
    std::vector<SceneInstance> instances;

    /// The entity of a node of an instance; kNoEntity where there is none.
    [[nodiscard]] Entity entity(uint32_t instance, uint32_t node) const {
        if (instance >= instances.size() || node >= instances[instance].nodes.size()) {
            return kNoEntity;
        }
        return instances[instance].nodes[node];
    }
    [[nodiscard]] const asset::SceneAsset& asset_of(const SceneInstance& instance) const {
        return *assets[instance.asset];
    }
};

/// The JSON text of an extension, null where the node has none of that name.
inline const std::string* find_extension(std::span<const asset::Extension> list,
                                         std::string_view name) {
    for (const asset::Extension& extension : list) {
        if (extension.name == name) return &extension.json;
    }
    return nullptr;
}

}  // namespace vellus::scene
