#include "modules/character/animation.h"

#include <algorithm>
#include <array>

#include "modules/character/sampling.h"

namespace vellus::character {
namespace {

using asset::AnimationChannel;
using asset::AnimationPath;

void apply_transform(const AnimationChannel& channel, double time, scene::LocalTransform& node) {
    std::array<float, 4> value{};
    if (channel.times.empty() || channel.width > value.size()) return;
    sample(channel, time, value);
    switch (channel.path) {
        case AnimationPath::kTranslation:
            node.translation = {value[0], value[1], value[2]};
            break;
        case AnimationPath::kRotation:
            node.rotation = {value[3], value[0], value[1], value[2]};
            break;
        case AnimationPath::kScale:
            node.scale = {value[0], value[1], value[2]};
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
    // Instances share no node, so players may run at the same time.
    players.parallel_each(
        [&](const scene::InstanceRoot& root, AnimationPlayer& player) {
            if (root.instance >= library->instances.size()) return;
            const scene::SceneInstance& instance = library->instances[root.instance];
            const auto& animations = library->asset_of(instance).animations;
            if (player.animation >= animations.size()) return;
            const asset::Animation& clip = animations[player.animation];
            const double time = clip_time(player.time + player.phase, clip.duration, player.loop);
            for (const AnimationChannel& channel : clip.channels) {
                const Entity entity = library->entity(root.instance, channel.node);
                if (channel.path == AnimationPath::kWeights) {
                    const auto slot = meshes.get(entity);
                    if (!slot || std::get<0>(*slot).weight_count != channel.width) continue;
                    sample(channel, time,
                           std::span(columns->weights)
                               .subspan(std::get<0>(*slot).first_weight, channel.width));
                } else if (const auto node = nodes.get(entity)) {
                    apply_transform(channel, time, std::get<0>(*node));
                }
            }
            player.time += step->dt * player.speed;
        },
        4);
}

}  // namespace vellus::character
