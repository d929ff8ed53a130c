#include "assets/generator/gltf_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace vellus::sculpt {

namespace {

using glm::dvec3;

int16_t snorm16(double x) {
    return static_cast<int16_t>(std::lround(std::clamp(x, -1.0, 1.0) * 32767.0));
}

glm::i16vec4 snorm(dvec3 v) {
    return {snorm16(v.x), snorm16(v.y), snorm16(v.z), int16_t{0}};
}

glm::i16vec4 snorm(glm::dquat q) {
    return {snorm16(q.x), snorm16(q.y), snorm16(q.z), snorm16(q.w)};
}

}  // namespace

GltfScene::GltfScene(std::string name) : name_(std::move(name)) {}

Node GltfScene::add_node(Json node, Node parent) {
    const Node index = nodes_.size();
    nodes_.push_back(std::move(node));
    if (parent == kNoNode) {
        roots_.push_back(index);
    } else {
        nodes_[parent]["children"].push_back(index);
    }
    return index;
}

Rig GltfScene::add_rig(std::span<const Joint> joints, Node parent, const std::string& prefix) {
    Rig rig{joints, {}};
    for (const Joint& joint : joints) {
        const auto above = static_cast<size_t>(joint.parent);
        const dvec3 from = joint.parent < 0 ? dvec3(0.0) : joints[above].position;
        rig.nodes.push_back(
            add_node({{"name", prefix + joint.name}, {"translation", list(joint.position - from)}},
                     joint.parent < 0 ? parent : rig.nodes[above]));
    }
    return rig;
}

Json GltfScene::add_geometry(const SkinnedPart& part) {
    const size_t count = part.surface.positions.size();
    std::vector<glm::vec3> positions;
    std::vector<glm::i16vec4> normals;
    std::vector<glm::u16vec4> colors;
    glm::vec3 low(1e9F);
    glm::vec3 high(-1e9F);
    for (size_t i = 0; i < count; ++i) {
        positions.emplace_back(part.surface.positions[i]);
        normals.push_back(snorm(part.surface.normals[i]));
        const dvec3 c = part.colors[i];
        colors.emplace_back(unorm16(c.x), unorm16(c.y), unorm16(c.z), uint16_t{65535});
        low = glm::min(low, positions.back());
        high = glm::max(high, positions.back());
    }
    const size_t position =
        buffer_.add(std::span<const glm::vec3>(positions), kFloat, "VEC3", GltfBuffer::kVertices);
    buffer_.set_range(position, {low.x, low.y, low.z}, {high.x, high.y, high.z});
    Json attributes = {{"POSITION", position}};
    // Three of four: vertices start at multiples of four bytes.
    attributes["NORMAL"] = buffer_.add(std::span<const glm::i16vec4>(normals), kInt16, "VEC3",
                                       GltfBuffer::kVertices, true);
    attributes["COLOR_0"] = buffer_.add(std::span<const glm::u16vec4>(colors), kUint16, "VEC4",
                                        GltfBuffer::kVertices, true);
    if (!part.influences.empty()) {
        std::vector<glm::u8vec4> joints;
        std::vector<glm::u16vec4> weights;
        for (const Influences& i : part.influences) {
            weights.push_back(unorm_shares(i.weights));
            joints.emplace_back(0);
            // A joint without weight must be joint 0.
            for (glm::length_t k = 0; k < 4; ++k) {
                joints.back()[k] =
                    weights.back()[k] == 0 ? uint8_t{0} : i.joints[static_cast<size_t>(k)];
            }
        }
        attributes["JOINTS_0"] = buffer_.add(std::span<const glm::u8vec4>(joints), kUint8, "VEC4",
                                             GltfBuffer::kVertices);
        attributes["WEIGHTS_0"] = buffer_.add(std::span<const glm::u16vec4>(weights), kUint16,
                                              "VEC4", GltfBuffer::kVertices, true);
    }
    const std::vector<uint16_t> indices(part.surface.indices.begin(), part.surface.indices.end());
    return {{"attributes", attributes},
            {"indices", buffer_.add(std::span<const uint16_t>(indices), kUint16, "SCALAR",
                                    GltfBuffer::kIndices)}};
}

size_t GltfScene::add_material(const std::string& name, dvec3 base_color, double roughness) {
    materials_.push_back(
        {{"name", name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {tidy(base_color.x), tidy(base_color.y), tidy(base_color.z), 1.0}},
           {"metallicFactor", 0.0},
           {"roughnessFactor", roughness}}}});
    return materials_.size() - 1;
}

size_t GltfScene::add_mesh(const std::string& name, Json primitives) {
    meshes_.push_back({{"name", name}, {"primitives", std::move(primitives)}});
    return meshes_.size() - 1;
}

size_t GltfScene::add_skin(const Rig& rig) {
    std::vector<glm::mat4> inverse_bind;
    for (const Joint& joint : rig.joints) {
        inverse_bind.emplace_back(1.0F);
        inverse_bind.back()[3] = glm::vec4(glm::vec3(-joint.position), 1.0F);
    }
    const size_t matrices =
        buffer_.add(std::span<const glm::mat4>(inverse_bind), kFloat, "MAT4", GltfBuffer::kNone);
    skins_.push_back({{"joints", rig.nodes},
                      {"inverseBindMatrices", matrices},
                      {"skeleton", rig.nodes.front()}});
    return skins_.size() - 1;
}

void GltfScene::add_clip(const std::string& name, std::span<const double> times,
                         std::span<const Track> tracks) {
    const std::vector<float> keys(times.begin(), times.end());
    const size_t input =
        buffer_.add(std::span<const float>(keys), kFloat, "SCALAR", GltfBuffer::kNone);
    buffer_.set_range(input, {keys.front()}, {keys.back()});
    Json samplers = Json::array();
    Json channels = Json::array();
    const auto add_channel = [&](Node node, const char* path, size_t output,
                                 const char* interpolation = "LINEAR") {
        samplers.push_back(
            {{"input", input}, {"output", output}, {"interpolation", interpolation}});
        channels.push_back(
            {{"sampler", samplers.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    };
    for (const Track& track : tracks) {
        if (!track.rotations.empty()) {
            std::vector<glm::i16vec4> values;
            for (const glm::dquat q : track.rotations) {
                values.push_back(snorm(q));
            }
            add_channel(track.node, "rotation",
                        buffer_.add(std::span<const glm::i16vec4>(values), kInt16, "VEC4",
                                    GltfBuffer::kNone, true));
        }
        if (!track.waypoints.empty()) {
            std::vector<glm::vec3> values;
            for (const Waypoint& at : track.waypoints) {
                values.insert(values.end(), {glm::vec3(at.velocity), glm::vec3(at.position),
                                             glm::vec3(at.velocity)});
            }
            add_channel(
                track.node, "translation",
                buffer_.add(std::span<const glm::vec3>(values), kFloat, "VEC3", GltfBuffer::kNone),
                "CUBICSPLINE");
        }
        if (!track.translations.empty()) {
            const std::vector<glm::vec3> values(track.translations.begin(),
                                                track.translations.end());
            add_channel(
                track.node, "translation",
                buffer_.add(std::span<const glm::vec3>(values), kFloat, "VEC3", GltfBuffer::kNone));
        }
    }
    clips_.push_back({{"name", name}, {"channels", channels}, {"samplers", samplers}});
}

std::vector<double> GltfScene::key_times(size_t keys, double seconds) {
    std::vector<double> times;
    for (size_t key = 0; key <= keys; ++key) {
        times.push_back(seconds * static_cast<double>(key) / static_cast<double>(keys));
    }
    return times;
}

std::vector<Track> GltfScene::tracks_of(const Rig& rig, size_t keys,
                                        const std::function<Pose(size_t)>& pose) {
    std::vector<Track> tracks;
    for (const Node node : rig.nodes) {
        tracks.push_back({node, {}, {}, {}});
    }
    for (size_t key = 0; key <= keys; ++key) {
        const Pose at = pose(key);
        for (size_t j = 0; j < tracks.size(); ++j) {
            glm::dquat q = at.rotations[j];
            // The shorter way round from the key before.
            if (!tracks[j].rotations.empty() && glm::dot(tracks[j].rotations.back(), q) < 0.0) {
                q = -q;
            }
            tracks[j].rotations.push_back(q);
        }
        tracks.front().translations.push_back(at.root);
    }
    return tracks;
}

Node GltfScene::add_ground(const Ground& ground) {
    const SkinnedPart part = make_ground(ground);
    Json lawn = add_geometry(part);
    lawn["material"] = add_material(part.name, part.base_color, part.roughness);
    return add_node({{"name", part.name},
                     {"translation", list(ground.center)},
                     {"mesh", add_mesh(part.name, Json::array({lawn}))}});
}

Node GltfScene::add_camera(dvec3 eye, dvec3 target, double vertical_fov, Node parent) {
    cameras_.push_back(
        {{"type", "perspective"}, {"perspective", {{"yfov", vertical_fov}, {"znear", 0.05}}}});
    return add_node({{"name", "camera"},
                     {"translation", list(eye)},
                     {"rotation", list(facing(target - eye))},
                     {"camera", cameras_.size() - 1}},
                    parent);
}

Node GltfScene::add_hair(const std::string& name, const std::string& groom, dvec3 place,
                         const Json& look, Node parent) {
    // Undoes what to_groom() did: the groom is Z up in centimetres.
    constexpr double kHalf = 0.70710678118654752;
    Json hair = {
        {"groom", "../grooms/" + groom},
        {"upright", false},
        {"transform", {{"rotation", {-kHalf, 0.0, 0.0, kHalf}}, {"scale", {0.01, 0.01, 0.01}}}}};
    hair.update(look);
    return add_node({{"name", name},
                     {"translation", list(place)},
                     {"extensions", {{"VELLUS_hair", std::move(hair)}}}},
                    parent);
}

Node GltfScene::add_collider(const BodyCapsule& capsule, dvec3 joint_at, Node joint) {
    return add_node(collider_node(capsule, joint_at), joint);
}

Node GltfScene::add_sun(dvec3 to_sun, dvec3 color, double intensity) {
    lights_.push_back({{"name", "sun"},
                       {"type", "directional"},
                       {"color", list(color)},
                       {"intensity", intensity}});
    return add_node({{"name", "sun"},
                     {"translation", {0.0, 3.0, 0.0}},
                     {"rotation", list(facing(-to_sun))},
                     {"extensions", {{"KHR_lights_punctual", {{"light", lights_.size() - 1}}}}}});
}

std::string GltfScene::json() const {
    Json gltf = {{"asset", {{"version", "2.0"}, {"generator", "vellus_make_assets"}}}};
    std::set<std::string> used = {"KHR_lights_punctual", "KHR_mesh_quantization"};
    for (const Json& node : nodes_) {
        if (node.contains("extensions")) {
            for (const auto& [extension, value] : node["extensions"].items()) {
                used.insert(extension);
            }
        }
    }
    gltf["extensionsUsed"] = used;
    gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
    gltf["scene"] = 0;
    gltf["scenes"] = Json::array({{{"name", name_}, {"nodes", roots_}}});
    gltf["nodes"] = nodes_;
    gltf["meshes"] = meshes_;
    gltf["materials"] = materials_;
    gltf["skins"] = skins_;
    gltf["animations"] = clips_;
    gltf["cameras"] = cameras_;
    gltf["extensions"] = {{"KHR_lights_punctual", {{"lights", lights_}}}};
    gltf["accessors"] = buffer_.accessors();
    gltf["bufferViews"] = buffer_.views();
    gltf["buffers"] =
        Json::array({{{"uri", name_ + ".bin"}, {"byteLength", buffer_.bytes().size()}}});
    return gltf.dump(1, ' ') + "\n";
}

}  // namespace vellus::sculpt
