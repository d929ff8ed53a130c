#include "modules/hair/grow/region.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <set>

#include "engine/asset/image_io.h"
#include "modules/hair/grow/chance.h"

namespace vellus::hair {

namespace {

using asset::Primitive;
using asset::SceneAsset;

glm::dmat4 rest_matrix(const SceneAsset& scene, uint32_t node) {
    glm::dmat4 world(1.0);
    for (size_t steps = 0; node < scene.nodes.size() && steps < scene.nodes.size(); ++steps) {
        const asset::Node& at = scene.nodes[node];
        world = glm::translate(glm::dmat4(1.0), glm::dvec3(at.translation)) *
                glm::mat4_cast(glm::dquat(at.rotation)) *
                glm::scale(glm::dmat4(1.0), glm::dvec3(at.scale)) * world;
        node = at.parent;
    }
    return world;
}

/// From mesh to scene for each joint of a skin, or the node's own matrix.
std::vector<glm::dmat4> placements(const SceneAsset& scene, const asset::Node& node,
                                   uint32_t index) {
    if (node.skin >= scene.skins.size()) return {rest_matrix(scene, index)};
    const asset::Skin& skin = scene.skins[node.skin];
    std::vector<glm::dmat4> matrices;
    for (size_t i = 0; i < skin.joints.size(); ++i) {
        const glm::dmat4 bind =
            i < skin.inverse_bind.size() ? glm::dmat4(skin.inverse_bind[i]) : glm::dmat4(1.0);
        matrices.push_back(rest_matrix(scene, skin.joints[i]) * bind);
    }
    return matrices;
}

glm::dmat4 placement_of(const Primitive& primitive, const std::vector<glm::dmat4>& matrices,
                        size_t vertex) {
    if (primitive.joints.empty() || matrices.size() == 1) return matrices.front();
    glm::dmat4 sum(0.0);
    for (int i = 0; i < 4; ++i) {
        const size_t joint = primitive.joints[vertex][i];
        if (joint < matrices.size()) {
            sum += matrices[joint] * double{primitive.weights[vertex][i]};
        }
    }
    return sum;
}

/// How vertices of one primitive answer to the group's name; empty where they do not know it.
std::vector<float> group_column(const SceneAsset& scene, const asset::Node& node,
                                const Primitive& primitive, const std::string& group) {
    const size_t dot = group.rfind('.');
    const std::string stem = group.substr(0, dot);
    const size_t channel =
        dot == std::string::npos ? 0 : std::string_view("rgba").find(group.substr(dot + 1));
    std::vector<float> values;
    if (stem == "COLOR_0" && channel < 4) {
        for (const glm::vec4& color : primitive.colors) {
            values.push_back(color[static_cast<int>(channel)]);
        }
    }
    for (const asset::VertexColumn& column : primitive.columns) {
        if (column.name != stem || channel >= column.components) continue;
        for (size_t i = channel; i < column.values.size(); i += column.components) {
            values.push_back(column.values[i]);
        }
    }
    if (values.empty() && node.skin < scene.skins.size() && !primitive.joints.empty()) {
        const auto& joints = scene.skins[node.skin].joints;
        const auto joint = std::ranges::find_if(joints, [&](uint32_t n) {
            return n < scene.nodes.size() && scene.nodes[n].name == group;
        });
        if (joint == joints.end()) return {};
        const auto wanted = static_cast<size_t>(joint - joints.begin());
        for (size_t v = 0; v < primitive.positions.size(); ++v) {
            float share = 0.0f;
            for (int i = 0; i < 4; ++i) {
                if (primitive.joints[v][i] == wanted) share += primitive.weights[v][i];
            }
            values.push_back(share);
        }
    }
    for (float& value : values) value = std::clamp(value, 0.0f, 1.0f);
    return values;
}

/// What group may name in this scene, for messages.
std::string known_groups(const SceneAsset& scene) {
    std::set<std::string> names;
    for (const asset::Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            if (!primitive.colors.empty()) names.insert("COLOR_0.r");
            for (const asset::VertexColumn& column : primitive.columns) names.insert(column.name);
        }
    }
    for (const asset::Skin& skin : scene.skins) {
        for (const uint32_t joint : skin.joints) {
            if (joint < scene.nodes.size() && !scene.nodes[joint].name.empty()) {
                names.insert(scene.nodes[joint].name);
            }
        }
    }
    if (names.empty()) return "its meshes have no such attribute and no skin: use a mask or sphere";
    return fmt::format("it has: {}", fmt::join(names, ", "));
}

class Builder {
  public:
    Builder(const SceneAsset& scene, const RegionChoice& choice) : scene_(scene), choice_(choice) {}

    Result<GrowSurface> build() {
        for (uint32_t n = 0; n < scene_.nodes.size(); ++n) {
            const asset::Node& node = scene_.nodes[n];
            if (node.mesh >= scene_.meshes.size()) continue;
            const asset::Mesh& mesh = scene_.meshes[node.mesh];
            const bool chosen =
                choice_.mesh.empty() || node.name == choice_.mesh || mesh.name == choice_.mesh;
            const auto matrices = placements(scene_, node, n);
            for (const Primitive& primitive : mesh.primitives) {
                if (primitive.topology == asset::Topology::kTriangles && !matrices.empty()) {
                    add(node, primitive, matrices, chosen);
                }
            }
            found_mesh_ |= chosen;
        }
        if (auto ok = check_found(); !ok) return ok.error();
        if (auto ok = add_mask(); !ok) return ok.error();
        return std::move(surface_);
    }

  private:
    void add(const asset::Node& node, const Primitive& primitive,
             const std::vector<glm::dmat4>& matrices, bool chosen) {
        const auto first = static_cast<uint32_t>(surface_.positions.size());
        std::vector<float> group;
        if (chosen && !choice_.group.empty()) {
            group = group_column(scene_, node, primitive, choice_.group);
            found_group_ |= !group.empty();
        }
        const bool mapped = !primitive.texcoords.empty();
        for (size_t v = 0; v < primitive.positions.size(); ++v) {
            const glm::dmat4 place = placement_of(primitive, matrices, v);
            surface_.positions.emplace_back(place * glm::dvec4(primitive.positions[v], 1.0));
            const glm::dvec3 normal =
                glm::transpose(glm::inverse(glm::dmat3(place))) * glm::dvec3(primitive.normals[v]);
            surface_.normals.emplace_back(grow::unit(normal, glm::dvec3(0.0, 1.0, 0.0)));
            surface_.uvs.push_back(mapped ? primitive.texcoords[v] : glm::vec2(0.0f));
            float density = chosen ? 1.0f : 0.0f;
            if (chosen && !choice_.group.empty()) density = group.empty() ? 0.0f : group[v];
            if (!mapped && !choice_.mask.empty()) density = 0.0f;
            surface_.density.push_back(density);
            if (density > most_) {
                most_ = density;
                surface_.to_mesh = glm::inverse(place);
            }
        }
        mapped_ |= mapped;
        for (const uint32_t index : primitive.indices) surface_.triangles.push_back(first + index);
    }

    Result<void> check_found() {
        const std::string where = scene_.path.string();
        if (surface_.triangles.empty()) {
            return Error{"has no triangles", where, "give a glTF with a mesh"};
        }
        if (!found_mesh_) {
            std::set<std::string> names;
            for (const asset::Node& node : scene_.nodes) {
                if (node.mesh < scene_.meshes.size()) {
                    names.insert(node.name);
                    names.insert(scene_.meshes[node.mesh].name);
                }
            }
            return Error{fmt::format("has no mesh '{}'", choice_.mesh), where,
                         fmt::format("it has: {}", fmt::join(names, ", "))};
        }
        if (!choice_.group.empty() && !found_group_) {
            return Error{fmt::format("has no vertex group '{}'", choice_.group), where,
                         known_groups(scene_)};
        }
        if (!mapped_) surface_.uvs.clear();
        return {};
    }

    Result<void> add_mask() {
        if (choice_.mask.empty() && !choice_.sphere) return {};
        std::shared_ptr<const asset::Image> picture;
        if (!choice_.mask.empty()) {
            auto image = asset::load_image(choice_.mask);
            if (!image) return image.error();
            if (!mapped_) {
                return Error{"has no texture coordinates for a mask", scene_.path.string(),
                             "choose by group or sphere"};
            }
            picture = std::make_shared<const asset::Image>(std::move(*image));
        }
        surface_.mask = [picture, sphere = choice_.sphere](glm::vec3 p, glm::vec2 uv) {
            if (sphere && glm::distance(p, glm::vec3(*sphere)) > sphere->w) return 0.0f;
            return picture ? brightness(*picture, uv) : 1.0f;
        };
        return {};
    }

    /// Bilinear, repeated beyond the edges; the mean of the channels, 0 to 1.
    static float brightness(const asset::Image& image, glm::vec2 uv) {
        const glm::vec2 size(image.width, image.height);
        const glm::vec2 at = (uv - glm::floor(uv)) * size - 0.5f;
        const glm::vec2 low = glm::floor(at);
        const glm::vec2 t = at - low;
        const auto texel = [&](float x, float y) {
            const auto column = static_cast<uint32_t>(x + size.x) % image.width;
            const auto row = static_cast<uint32_t>(y + size.y) % image.height;
            const uint8_t* rgba = &image.rgba[4 * (size_t{row} * image.width + column)];
            return static_cast<float>(rgba[0] + rgba[1] + rgba[2]) / 765.0f;
        };
        return glm::mix(glm::mix(texel(low.x, low.y), texel(low.x + 1, low.y), t.x),
                        glm::mix(texel(low.x, low.y + 1), texel(low.x + 1, low.y + 1), t.x), t.y);
    }

    const SceneAsset& scene_;
    const RegionChoice& choice_;
    GrowSurface surface_;
    float most_ = 0.0f;
    bool found_mesh_ = false;
    bool found_group_ = false;
    bool mapped_ = false;
};

}  // namespace

Result<GrowSurface> surface_from_scene(const SceneAsset& scene, const RegionChoice& choice) {
    return Builder(scene, choice).build();
}

Result<glm::dmat4> rest_transform(const SceneAsset& scene, const std::string& node) {
    std::set<std::string> names;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].name == node) return rest_matrix(scene, n);
        if (!scene.nodes[n].name.empty()) names.insert(scene.nodes[n].name);
    }
    return Error{fmt::format("has no node '{}'", node), scene.path.string(),
                 fmt::format("it has: {}", fmt::join(names, ", "))};
}

}  // namespace vellus::hair
