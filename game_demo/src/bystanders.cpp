#include "game_demo/src/bystanders.h"

#include <algorithm>
#include <cmath>

#include "modules/scene/library.h"

namespace vellus::demo {

namespace {

/// Metres between the middles of two people who stand shoulder to shoulder.
constexpr double kApart = 0.5;

bool is_below(World& world, Entity entity, Entity ancestor) {
    while (entity != ancestor) {
        const auto* parent = world.get<scene::Parent>(entity);
        if (parent == nullptr) return false;
        entity = parent->entity;
    }
    return true;
}

}  // namespace

Bystanders::Bystanders(World& world, Entity walker) {
    const auto& library = world.resource<scene::SceneLibrary>();
    for (const scene::SceneInstance& instance : library.instances) {
        for (const asset::Skin& skin : library.asset_of(instance).skins) {
            std::vector<Entity> joints;
            for (const uint32_t node : skin.joints) {
                const Entity joint = instance.nodes[node];
                if (world.get<scene::WorldTransform>(joint) != nullptr) joints.push_back(joint);
            }
            const bool own = std::ranges::any_of(
                joints, [&](Entity joint) { return is_below(world, joint, walker); });
            if (!joints.empty() && !own) skeletons_.push_back(std::move(joints));
        }
    }
}

glm::dvec3 Bystanders::clear_of(World& world, const glm::dvec3& feet) const {
    glm::dvec3 clear = feet;
    for (const std::vector<Entity>& joints : skeletons_) {
        glm::dvec3 middle(0.0);
        double lowest = HUGE_VAL;
        double highest = -HUGE_VAL;
        for (const Entity joint : joints) {
            const glm::dvec3 at = world.get<scene::WorldTransform>(joint)->matrix[3];
            middle += at / static_cast<double>(joints.size());
            lowest = std::min(lowest, at.y);
            highest = std::max(highest, at.y);
        }
        const double height = clear.y;
        const glm::dvec2 aside(clear.x - middle.x, clear.z - middle.z);
        const double distance = glm::length(aside);
        if (height > highest || height + 1.0 < lowest || distance >= kApart) continue;
        const glm::dvec2 way = distance > 0.0 ? aside / distance : glm::dvec2(1.0, 0.0);
        clear.x = middle.x + kApart * way.x;
        clear.z = middle.z + kApart * way.y;
    }
    return clear;
}

}  // namespace vellus::demo
