#include <cmath>
#include <set>

#include "engine/asset/gltf_context.h"

// glTF 2.0 specification, chapters 3.7.3 (skins) and 3.11 (animations).
namespace vellus::asset::detail {
namespace {

constexpr const char* kExportAgain = "export it again";

std::optional<AnimationPath> parse_path(const std::string& name) {
    static const std::map<std::string, AnimationPath> kPaths = {
        {"translation", AnimationPath::kTranslation},
        {"rotation", AnimationPath::kRotation},
        {"scale", AnimationPath::kScale},
        {"weights", AnimationPath::kWeights}};
    const auto found = kPaths.find(name);
    return found == kPaths.end() ? std::nullopt : std::optional(found->second);
}

Interpolation parse_interpolation(const std::string& name, const std::string& pointer,
                                  Context& context) {
    if (name == "STEP") {
        return Interpolation::kStep;
    }
    if (name == "CUBICSPLINE") {
        return Interpolation::kCubicSpline;
    }
    if (!name.empty() && name != "LINEAR") {
        context.warn(pointer,
                     fmt::format("unknown interpolation '{}' read as LINEAR", name.substr(0, 40)));
    }
    return Interpolation::kLinear;
}

/// The first key that is not after the one before it, or before time 0; nothing where all are in
/// order.
std::optional<size_t> disorder(const std::vector<float>& times) {
    for (size_t i = 0; i < times.size(); ++i) {
        const bool increasing = i == 0 ? times[0] >= 0.0f : times[i] > times[i - 1];
        if (!increasing) {
            return i;
        }
    }
    return std::nullopt;
}

/// Rotations of a key must have length 1; tangents need not.
void normalise_rotations(const std::string& pointer, Context& context, AnimationChannel& channel) {
    const bool cubic = channel.interpolation == Interpolation::kCubicSpline;
    size_t repaired = 0;
    for (size_t i = cubic ? 4 : 0; i < channel.values.size(); i += cubic ? 12 : 4) {
        float* q = channel.values.data() + i;
        const double length = std::sqrt(double{q[0]} * q[0] + double{q[1]} * q[1] +
                                        double{q[2]} * q[2] + double{q[3]} * q[3]);
        // 8-bit components are off by up to 1/254 each.
        repaired += std::abs(length - 1.0) > 1e-2 ? 1U : 0U;
        for (size_t c = 0; c < 4; ++c) {
            const float identity = c == 3 ? 1.0f : 0.0f;
            q[c] = length > 0.0 ? static_cast<float>(q[c] / length) : identity;
        }
    }
    if (repaired > 0) {
        context.warn(pointer,
                     fmt::format("{} rotations were no unit quaternions; normalised", repaired));
    }
}

uint32_t channel_width(const AnimationChannel& channel, const SceneAsset& scene) {
    switch (channel.path) {
        case AnimationPath::kRotation:
            return 4;
        case AnimationPath::kWeights: {
            const uint32_t mesh = scene.nodes[channel.node].mesh;
            return mesh == kNone ? 0
                                 : static_cast<uint32_t>(scene.meshes[mesh].morph_weights.size());
        }
        default:
            return 3;
    }
}

/// Keys and values of a channel whose node and path are known. False where its keys have no order
/// in time.
bool read_keys(const tinygltf::AnimationSampler& sampler, const std::string& pointer,
               Context& context, AnimationChannel& channel) {
    channel.interpolation =
        parse_interpolation(sampler.interpolation, pointer + "/interpolation", context);
    if (!accessor_is_float(context, sampler.input)) {
        refuse(pointer + "/input", "times are not floats", kExportAgain);
    }
    channel.times = read_floats(context, sampler.input, 1, pointer + "/input");
    if (const auto key = disorder(channel.times)) {
        context.warn(
            pointer + "/input",
            fmt::format(
                "key {} at {} s: times must start at 0 or later and increase; channel left out",
                *key, channel.times[*key]));
        return false;
    }
    const bool weights = channel.path == AnimationPath::kWeights;
    const int components = weights ? 1 : static_cast<int>(channel.width);
    channel.values = read_floats(context, sampler.output, components, pointer + "/output");
    const size_t per_key =
        size_t{channel.width} * (channel.interpolation == Interpolation::kCubicSpline ? 3 : 1);
    if (channel.values.size() != channel.times.size() * per_key) {
        refuse(pointer + "/output",
               fmt::format("{} numbers for {} keys of {}", channel.values.size(),
                           channel.times.size(), per_key),
               kExportAgain);
    }
    if (channel.path == AnimationPath::kRotation) {
        normalise_rotations(pointer + "/output", context, channel);
    }
    return true;
}

/// Nothing for a channel that moves nothing this engine knows.
std::optional<AnimationChannel> read_channel(const tinygltf::Animation& animation, size_t index,
                                             const std::string& pointer, Context& context,
                                             const SceneAsset& scene) {
    const tinygltf::AnimationChannel& from = animation.channels[index];
    const std::string place = fmt::format("{}/channels/{}", pointer, index);
    const auto path = parse_path(from.target_path);
    if (!path) {
        context.warn(place + "/target/path",
                     fmt::format("'{}' is not animated; left out", from.target_path.substr(0, 40)));
        return std::nullopt;
    }
    AnimationChannel channel;
    channel.node = static_cast<uint32_t>(from.target_node);
    channel.path = *path;
    channel.width = channel_width(channel, scene);
    if (channel.width == 0) {
        context.warn(place + "/target",
                     fmt::format("node {} has no morph targets; left out", channel.node));
        return std::nullopt;
    }
    if (static_cast<size_t>(from.sampler) >= animation.samplers.size()) {
        refuse(
            place + "/sampler",
            fmt::format("{} is none of the {} samplers", from.sampler, animation.samplers.size()),
            kExportAgain);
    }
    if (!context.model.nodes[channel.node].matrix.empty()) {
        context.warn(place + "/target/node",
                     fmt::format("node {} has a matrix, which is replaced", channel.node));
    }
    const bool ordered =
        read_keys(animation.samplers[static_cast<size_t>(from.sampler)],
                  fmt::format("{}/samplers/{}", pointer, from.sampler), context, channel);
    return ordered ? std::optional(std::move(channel)) : std::nullopt;
}

Animation read_animation(size_t index, Context& context, const SceneAsset& scene) {
    const tinygltf::Animation& from = context.model.animations[index];
    const std::string pointer = fmt::format("/animations/{}", index);
    const size_t listed = context.doc["animations"][index]["channels"].size();
    if (from.channels.size() != listed) {
        context.warn(pointer + "/channels",
                     fmt::format("{} channels without a target node left out",
                                 listed - from.channels.size()));
    }
    Animation animation;
    animation.name = from.name;
    std::set<std::pair<uint32_t, AnimationPath>> targets;
    for (size_t i = 0; i < from.channels.size(); ++i) {
        auto channel = read_channel(from, i, pointer, context, scene);
        if (!channel) {
            continue;
        }
        if (!targets.emplace(channel->node, channel->path).second) {
            context.warn(fmt::format("{}/channels/{}", pointer, i),
                         "moves what another channel moves; left out");
            continue;
        }
        animation.duration = std::max(animation.duration, channel->times.back());
        animation.channels.push_back(std::move(*channel));
    }
    return animation;
}

std::vector<glm::mat4> read_inverse_bind(Context& context, const tinygltf::Skin& from,
                                         const std::string& pointer) {
    const size_t count = from.joints.size();
    std::vector<glm::mat4> matrices(count, glm::mat4(1.0f));
    if (from.inverseBindMatrices < 0) {
        return matrices;
    }
    const std::string place = pointer + "/inverseBindMatrices";
    if (accessor_count(context, from.inverseBindMatrices) < count) {
        refuse(place,
               fmt::format("{} matrices for {} joints",
                           accessor_count(context, from.inverseBindMatrices), count),
               kExportAgain);
    }
    const std::vector<float> floats = read_floats(context, from.inverseBindMatrices, 16, place);
    for (size_t i = 0; i < count; ++i) {
        const float* m = floats.data() + 16 * i;
        // Exporters round: the last row may be off a little, but not mean a projection.
        if (std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1.0f) > 1e-3f) {
            refuse(place, fmt::format("the last row of matrix {} is not 0 0 0 1", i), kExportAgain);
        }
        for (glm::length_t c = 0; c < 4; ++c) {
            matrices[i][c] = glm::vec4(m[4 * c], m[4 * c + 1], m[4 * c + 2], c == 3 ? 1.0f : 0.0f);
        }
    }
    return matrices;
}

}  // namespace

void read_skins(Context& context, SceneAsset& scene) {
    for (size_t i = 0; i < context.model.skins.size(); ++i) {
        const tinygltf::Skin& from = context.model.skins[i];
        const std::string pointer = fmt::format("/skins/{}", i);
        if (from.joints.empty()) {
            refuse(pointer + "/joints", "no joints", kExportAgain);
        }
        Skin skin;
        skin.name = from.name;
        skin.joints.assign(from.joints.begin(), from.joints.end());
        context.charge(from.joints.size(), sizeof(glm::mat4), pointer);
        skin.inverse_bind = read_inverse_bind(context, from, pointer);
        scene.skins.push_back(std::move(skin));
    }
}

void read_animations(Context& context, SceneAsset& scene) {
    for (size_t i = 0; i < context.model.animations.size(); ++i) {
        scene.animations.push_back(read_animation(i, context, scene));
    }
}

}  // namespace vellus::asset::detail
