#include "modules/character/animation.h"

#include <algorithm>
#include <array>

#include "modules/character/sampling.h"

namespace vellus::character {
namespace {

using asset::AnimationChannel;
using asset::AnimationPath;

/// Moves a node by `share` of the way from its pose to the channel's.
void apply_transform(const AnimationChannel& channel, double time, float share,
                     scene::LocalTransform& node) {
    std::array<float, 4> value{};
    if (channel.times.empty() || channel.width > value.size()) return;
    sample(channel, time, value);
    const glm::vec3 vector(value[0], value[1], value[2]);
    switch (channel.path) {
        case AnimationPath::kTranslation:
            node.translation = share == 1.0f ? glm::dvec3(vector)
                                             : glm::mix(node.translation, glm::dvec3(vector),
                                                        static_cast<double>(share));
            break;
        case AnimationPath::kRotation: {
            const glm::quat rotation(value[3], value[0], value[1], value[2]);
            node.rotation = share == 1.0f ? rotation : glm::slerp(node.rotation, rotation, share);
            break;
        }
        case AnimationPath::kScale:
            node.scale = share == 1.0f ? vector : glm::mix(node.scale, vector, share);
            break;
        case AnimationPath::kWeights:
            break;
    }
}

}  // namespace

void animate(Query<const scene::InstanceRoot, AnimationPlayer> players,
             Query<scene::LocalTransform> nodes, Query<const MeshSlot> meshes,
             Res<const scene::SceneLibrary> library, Res<const scene::FixedStep> step,
             Res<DeformColumns> columns) {
    columns->previous_weights = columns->weights;
    const auto apply = [&](uint32_t index, const asset::Animation& clip, double time, float share) {
        for (const AnimationChannel& channel : clip.channels) {
            const Entity entity = library->entity(index, channel.node);
            if (channel.path == AnimationPath::kWeights) {
                const auto slot = meshes.get(entity);
                if (!slot || std::get<0>(*slot).weight_count != channel.width) continue;
                // Weights are not mixed: the clip with the larger share has them.
                if (share < 0.5f) continue;
                sample(channel, time,
                       std::span(columns->weights)
                           .subspan(std::get<0>(*slot).first_weight, channel.width));
            } else if (const auto node = nodes.get(entity)) {
                apply_transform(channel, time, share, std::get<0>(*node));
            }
        }
    };
    // Instances share no node, so players may run at the same time.
    players.parallel_each(
        [&](const scene::InstanceRoot& root, AnimationPlayer& player) {
            if (root.instance >= library->instances.size()) return;
            const scene::SceneInstance& instance = library->instances[root.instance];
            const auto& animations = library->asset_of(instance).animations;
            if (player.animation >= animations.size()) return;
            const asset::Animation& clip = animations[player.animation];
            apply(root.instance, clip,
                  clip_time(player.time + player.phase, clip.duration, player.loop), 1.0f);
            if (player.mix > 0.0f && player.other < animations.size()) {
                const asset::Animation& other = animations[player.other];
                apply(root.instance, other, clip_time(player.other_time, other.duration, true),
                      player.mix);
            }
            player.time += step->dt * player.speed;
            player.other_time += step->dt * player.other_speed;
        },
        4);
}

}  // namespace vellus::character
