#include <algorithm>
#include <cmath>

#include "engine/asset/gltf_context.h"

// glTF 2.0 specification, chapter 3.5 (scenes, nodes, transformations) and 3.10 (cameras);
// KHR_lights_punctual.
namespace vellus::asset::detail {
namespace {

/// Translation, rotation and scale of a matrix; shear cannot be kept and is reported.
void decompose(const std::vector<double>& m, const std::string& pointer, Context& context,
               Node& node) {
    if (std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1.0) > 1e-5) {
        refuse(pointer, "the last row is not 0 0 0 1", "use an affine matrix");
    }
    std::array<glm::dvec3, 3> axes;
    for (size_t i = 0; i < 3; ++i) {
        axes[i] = glm::dvec3(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
    }
    glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
    if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0.0) {
        scale.x = -scale.x;
    }
    // Gram-Schmidt from the third axis on, so that axes of length zero get directions that fit the
    // others.
    const auto unit_or = [](const glm::dvec3& v, const glm::dvec3& other) {
        const double length = glm::length(v);
        return length > 0.0 ? v / length : other;
    };
    const glm::dvec3 z = unit_or(
        axes[2],
        unit_or(glm::cross(axes[0] / (scale.x != 0.0 ? scale.x : 1.0), axes[1]), {0, 0, 1}));
    const glm::dvec3 x_raw = scale.x != 0.0 ? axes[0] / scale.x : glm::cross(axes[1], z);
    const glm::dvec3 spare = std::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x =
        unit_or(x_raw - z * glm::dot(x_raw, z), glm::normalize(spare - z * glm::dot(spare, z)));
    const glm::dmat3 rotation(x, glm::cross(z, x), z);
    double shear = 0.0;
    for (glm::length_t i = 0; i < 3; ++i) {
        shear = std::max(shear, glm::length(rotation[i] * scale[i] - axes[static_cast<size_t>(i)]));
    }
    if (shear > 1e-3 * std::max({std::abs(scale.x), scale.y, scale.z})) {
        context.warn(pointer, "the matrix shears; read without the shear");
    }
    node.translation = glm::vec3(m[12], m[13], m[14]);
    node.rotation = glm::quat(glm::normalize(glm::quat_cast(rotation)));
    node.scale = glm::vec3(scale);
}

void read_transform(const tinygltf::Node& from, const Json& json, const std::string& pointer,
                    Context& context, Node& node) {
    if (!from.matrix.empty()) {
        for (const char* name : {"translation", "rotation", "scale"}) {
            if (json.contains(name)) {
                context.warn(fmt::format("{}/{}", pointer, name),
                             "left out: the node has a matrix as well");
            }
        }
        decompose(from.matrix, pointer + "/matrix", context, node);
        return;
    }
    if (!from.translation.empty()) {
        node.translation = glm::vec3(from.translation[0], from.translation[1], from.translation[2]);
    }
    if (!from.scale.empty()) {
        node.scale = glm::vec3(from.scale[0], from.scale[1], from.scale[2]);
    }
    if (!from.rotation.empty()) {
        const glm::dquat q(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
        const double length = glm::length(q);
        if (!(std::abs(length - 1.0) <= 5e-3)) {
            context.warn(pointer + "/rotation",
                         fmt::format("a quaternion of length {:g} normalised", length));
        }
        node.rotation = length > 0.0 ? glm::quat(q / length) : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
    }
}

void read_extensions(const Json& object, std::vector<Extension>& extensions) {
    for (const auto& [name, extension] : member(object, "extensions").items()) {
        if (name != "KHR_lights_punctual") {
            extensions.push_back({name, extension.dump()});
        }
    }
}

Node read_node(size_t index, Context& context, const SceneAsset& scene) {
    static const Json::json_pointer kLight("/extensions/KHR_lights_punctual/light");
    const tinygltf::Node& from = context.model.nodes[index];
    const Json& json = context.doc["nodes"][index];
    const std::string pointer = fmt::format("/nodes/{}", index);
    Node node;
    node.name = from.name;
    node.children.assign(from.children.begin(), from.children.end());
    node.mesh = to_index(from.mesh);
    node.skin = to_index(from.skin);
    node.camera = to_index(from.camera);
    node.light = json.contains(kLight) ? json[kLight].get<uint32_t>() : kNone;
    node.morph_weights.assign(from.weights.begin(), from.weights.end());
    const size_t targets = node.mesh == kNone ? 0 : scene.meshes[node.mesh].morph_weights.size();
    if (!node.morph_weights.empty() && node.morph_weights.size() != targets) {
        context.warn(pointer + "/weights", fmt::format("{} weights for {} morph targets; left out",
                                                       from.weights.size(), targets));
        node.morph_weights.clear();
    }
    read_transform(from, json, pointer, context, node);
    read_extensions(json, node.extensions);
    return node;
}

void set_parents(SceneAsset& scene) {
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        for (const uint32_t child : scene.nodes[i].children) {
            if (scene.nodes[child].parent != kNone) {
                refuse(fmt::format("/nodes/{}/children", i),
                       fmt::format("node {} is a child of node {} already", child,
                                   scene.nodes[child].parent),
                       "give every node one parent");
            }
            scene.nodes[child].parent = static_cast<uint32_t>(i);
        }
    }
}

/// Every node has at most one parent here, so what cannot be reached from above lies on a cycle.
void check_tree(const Context& context, const SceneAsset& scene) {
    std::vector<uint32_t> level;
    for (uint32_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent == kNone) {
            level.push_back(i);
        }
    }
    size_t reached = 0;
    for (uint32_t depth = 1; !level.empty(); ++depth) {
        if (depth > context.limits.node_depth) {
            refuse(fmt::format("/nodes/{}", level.front()),
                   fmt::format("nodes nested deeper than {}", depth - 1), "flatten the hierarchy");
        }
        reached += level.size();
        std::vector<uint32_t> next;
        for (const uint32_t i : level) {
            next.insert(next.end(), scene.nodes[i].children.begin(), scene.nodes[i].children.end());
        }
        level = std::move(next);
    }
    if (reached != scene.nodes.size()) {
        refuse("/nodes",
               fmt::format("{} nodes are their own ancestors or hang below such",
                           scene.nodes.size() - reached),
               "break the cycle in children");
    }
}

void read_roots(Context& context, SceneAsset& scene) {
    if (context.model.scenes.empty()) {
        for (uint32_t i = 0; i < scene.nodes.size(); ++i) {
            if (scene.nodes[i].parent == kNone) {
                scene.roots.push_back(i);
            }
        }
        return;
    }
    const size_t index = static_cast<size_t>(std::max(context.model.defaultScene, 0));
    for (size_t s = 0; s < context.model.scenes.size(); ++s) {
        for (const int node : context.model.scenes[s].nodes) {
            const auto n = static_cast<uint32_t>(node);
            const std::string pointer = fmt::format("/scenes/{}/nodes", s);
            if (scene.nodes[n].parent != kNone) {
                refuse(pointer,
                       fmt::format("node {} is a child of node {}", n, scene.nodes[n].parent),
                       "list only nodes without parent");
            }
            if (s != index) {
                continue;
            }
            if (std::find(scene.roots.begin(), scene.roots.end(), n) == scene.roots.end()) {
                scene.roots.push_back(n);
            } else {
                context.warn(pointer, fmt::format("node {} is listed twice", n));
            }
        }
    }
    read_extensions(context.doc["scenes"][index], scene.extensions);
}

}  // namespace

void read_nodes(Context& context, SceneAsset& scene) {
    for (size_t i = 0; i < context.model.nodes.size(); ++i) {
        scene.nodes.push_back(read_node(i, context, scene));
    }
    set_parents(scene);
    check_tree(context, scene);
    read_roots(context, scene);
}

}  // namespace vellus::asset::detail
