#include "tests/unit/asset/scene_invariants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vellus::asset::test {
namespace {

bool in_range(uint32_t index, size_t size) {
    return index == kNone || index < size;
}

template <class Vectors>
bool finite(const Vectors& vectors) {
    for (const auto& v : vectors) {
        for (glm::length_t i = 0; i < v.length(); ++i) {
            if (!std::isfinite(v[i])) {
                return false;
            }
        }
    }
    return true;
}

template <class Vectors>
bool absent_or(const Vectors& vectors, size_t count) {
    return vectors.empty() || vectors.size() == count;
}

std::string check_primitive(const Primitive& p, size_t morph_weights, const SceneAsset& scene) {
    const size_t n = p.positions.size();
    if (!absent_or(p.normals, n) || !absent_or(p.texcoords, n) || !absent_or(p.colors, n) ||
        !absent_or(p.joints, n) || p.weights.size() != p.joints.size() ||
        p.morph_targets.size() != morph_weights) {
        return "attribute lengths";
    }
    if (!finite(p.positions) || !finite(p.normals) || !finite(p.texcoords) || !finite(p.colors) ||
        !finite(p.weights)) {
        return "attributes not finite";
    }
    if (!std::all_of(p.indices.begin(), p.indices.end(), [n](uint32_t i) { return i < n; }) ||
        (p.topology == Topology::kTriangles && p.indices.size() % 3 != 0)) {
        return "indices";
    }
    for (const MorphTarget& target : p.morph_targets) {
        if (!absent_or(target.positions, n) || !absent_or(target.normals, n) ||
            !finite(target.positions) || !finite(target.normals)) {
            return "morph target";
        }
    }
    if (p.topology == Topology::kTriangles) {
        const bool unit = p.normals.size() == n &&
                          std::all_of(p.normals.begin(), p.normals.end(), [](const glm::vec3& v) {
                              return std::abs(glm::length(v) - 1.0f) < 1e-5f;
                          });
        if (!unit) {
            return "normals";
        }
    }
    for (const glm::vec4& w : p.weights) {
        const float least = std::min({w.x, w.y, w.z, w.w});
        if (least < 0.0f || std::abs(w.x + w.y + w.z + w.w - 1.0f) > 1e-5f) {
            return "weights";
        }
    }
    return in_range(p.material, scene.materials.size()) ? "" : "material";
}

std::string check_nodes(const SceneAsset& scene) {
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        size_t steps = 0;
        for (uint32_t up = node.parent; up != kNone; up = scene.nodes.at(up).parent) {
            if (++steps > scene.nodes.size()) {
                return "cycle";
            }
        }
        for (const uint32_t child : node.children) {
            if (scene.nodes.at(child).parent != i) {
                return "parent";
            }
        }
        if (!in_range(node.mesh, scene.meshes.size()) || !in_range(node.skin, scene.skins.size()) ||
            !in_range(node.camera, scene.cameras.size()) ||
            !in_range(node.light, scene.lights.size())) {
            return "node reference";
        }
        const bool numbers = finite(std::vector{node.translation, node.scale});
        if (!numbers || std::abs(glm::length(node.rotation) - 1.0f) > 1e-5f) {
            return "node transform";
        }
        if (node.mesh != kNone && node.skin != kNone) {
            for (const Primitive& p : scene.meshes[node.mesh].primitives) {
                for (const glm::u16vec4& joints : p.joints) {
                    if (std::max({joints.x, joints.y, joints.z, joints.w}) >=
                        scene.skins[node.skin].joints.size()) {
                        return "joint of a vertex";
                    }
                }
            }
        }
    }
    return std::all_of(
               scene.roots.begin(), scene.roots.end(),
               [&](uint32_t r) { return r < scene.nodes.size() && scene.nodes[r].parent == kNone; })
               ? ""
               : "roots";
}

std::string check_animation(const Animation& animation, const SceneAsset& scene) {
    for (const AnimationChannel& c : animation.channels) {
        const size_t per_key =
            size_t{c.width} * (c.interpolation == Interpolation::kCubicSpline ? 3 : 1);
        const bool sorted = std::adjacent_find(c.times.begin(), c.times.end(),
                                               std::greater_equal<>()) == c.times.end();
        const auto is_finite = [](float v) { return std::isfinite(v); };
        if (c.node >= scene.nodes.size() || c.times.empty() ||
            c.values.size() != c.times.size() * per_key || !sorted || c.times.front() < 0.0f ||
            c.times.back() > animation.duration ||
            !std::all_of(c.times.begin(), c.times.end(), is_finite) ||
            !std::all_of(c.values.begin(), c.values.end(), is_finite)) {
            return "animation channel";
        }
    }
    return "";
}

std::string check_rest(const SceneAsset& scene) {
    for (const Skin& skin : scene.skins) {
        const bool joints = std::all_of(skin.joints.begin(), skin.joints.end(),
                                        [&](uint32_t j) { return j < scene.nodes.size(); });
        if (!joints || skin.joints.empty() || skin.inverse_bind.size() != skin.joints.size()) {
            return "skin";
        }
    }
    for (const Material& m : scene.materials) {
        for (const uint32_t image :
             {m.base_color_image, m.metallic_roughness_image, m.normal_image}) {
            if (image != kNone &&
                (image >= scene.images.size() || scene.images[image].rgba.empty())) {
                return "material image";
            }
        }
        if (!finite(std::vector{m.base_color}) || !finite(std::vector{m.emissive})) {
            return "material factor";
        }
    }
    for (const Camera& c : scene.cameras) {
        const bool clip =
            c.near_plane >= 0.0f && (c.far_plane == 0.0f || c.far_plane > c.near_plane);
        if (!clip || !(c.vertical_fov > 0.0f && c.vertical_fov < 3.1416f) ||
            !(c.half_extent.x > 0.0f)) {
            return "camera";
        }
    }
    for (const Light& l : scene.lights) {
        const bool cone =
            l.kind != LightKind::kSpot ||
            (l.inner_cone >= 0.0f && l.inner_cone <= l.outer_cone && l.outer_cone <= 1.5708f);
        if (!(l.intensity >= 0.0f) || !(l.range >= 0.0f) || !cone ||
            !finite(std::vector{l.color})) {
            return "light";
        }
    }
    return "";
}

}  // namespace

std::string broken_promise(const SceneAsset& scene) {
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        for (const Primitive& p : scene.meshes[m].primitives) {
            if (auto broken = check_primitive(p, scene.meshes[m].morph_weights.size(), scene);
                !broken.empty()) {
                return fmt::format("mesh {}: {}", m, broken);
            }
        }
    }
    if (auto broken = check_nodes(scene); !broken.empty()) {
        return broken;
    }
    for (const Animation& animation : scene.animations) {
        if (auto broken = check_animation(animation, scene); !broken.empty()) {
            return broken;
        }
    }
    return check_rest(scene);
}

}  // namespace vellus::asset::test
