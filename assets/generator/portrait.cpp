#include "assets/generator/portrait.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "assets/generator/body_colliders.h"
#include "assets/generator/gltf_buffer.h"
#include "assets/generator/gltf_values.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

// Joints in the bust's own space, whose origin is the middle of the head.
constexpr dvec3 kTorso(0.0, -0.300, -0.050);
constexpr dvec3 kNeck(0.0, -0.170, -0.045);
constexpr dvec3 kHead(0.0, -0.075, -0.020);
/// The bust stands on the ground.
constexpr dvec3 kBust(0.0, 0.400, 0.0);

// The scene's nodes.
enum Node : int {
    kBustNode,
    kTorsoNode,
    kNeckNode,
    kHeadNode,
    kHairNode,
    kBrowsNode,
    kMeshNode,
    kCameraNode,
    kSunNode,
    kRimNode
};

Json add_part(GltfBuffer& buffer, const Part& part, int material) {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::u16vec4> colors;
    std::vector<glm::u8vec4> joints(part.surface.positions.size(), glm::u8vec4(0, 1, 2, 0));
    std::vector<glm::u16vec4> weights;
    glm::vec3 low(1e9F);
    glm::vec3 high(-1e9F);
    for (size_t i = 0; i < part.surface.positions.size(); ++i) {
        positions.emplace_back(part.surface.positions[i]);
        normals.emplace_back(part.surface.normals[i]);
        const dvec3 c = part.colors[i];
        colors.emplace_back(unorm16(c.x), unorm16(c.y), unorm16(c.z), uint16_t{65535});
        const dvec3& shares = part.weights[i];
        weights.push_back(unorm_shares({shares.x, shares.y, shares.z, 0.0}));
        // A joint without weight must be joint 0.
        joints[i].y = weights[i].y == 0 ? 0 : 1;
        joints[i].z = weights[i].z == 0 ? 0 : 2;
        low = glm::min(low, positions.back());
        high = glm::max(high, positions.back());
    }
    const std::vector<uint16_t> indices(part.surface.indices.begin(), part.surface.indices.end());
    const size_t position =
        buffer.add(std::span<const glm::vec3>(positions), kFloat, "VEC3", GltfBuffer::kVertices);
    buffer.set_range(position, {low.x, low.y, low.z}, {high.x, high.y, high.z});
    Json attributes = {{"POSITION", position}};
    attributes["NORMAL"] =
        buffer.add(std::span<const glm::vec3>(normals), kFloat, "VEC3", GltfBuffer::kVertices);
    attributes["COLOR_0"] = buffer.add(std::span<const glm::u16vec4>(colors), kUint16, "VEC4",
                                       GltfBuffer::kVertices, true);
    attributes["JOINTS_0"] =
        buffer.add(std::span<const glm::u8vec4>(joints), kUint8, "VEC4", GltfBuffer::kVertices);
    attributes["WEIGHTS_0"] = buffer.add(std::span<const glm::u16vec4>(weights), kUint16, "VEC4",
                                         GltfBuffer::kVertices, true);
    return {{"attributes", attributes},
            {"indices", buffer.add(std::span<const uint16_t>(indices), kUint16, "SCALAR",
                                   GltfBuffer::kIndices)},
            {"material", material}};
}

Json add_skin(GltfBuffer& buffer) {
    std::vector<glm::mat4> inverse_bind;
    for (const dvec3 joint : {kTorso, kNeck, kHead}) {
        inverse_bind.emplace_back(1.0F);
        inverse_bind.back()[3] = glm::vec4(glm::vec3(-joint), 1.0F);
    }
    const size_t matrices =
        buffer.add(std::span<const glm::mat4>(inverse_bind), kFloat, "MAT4", GltfBuffer::kNone);
    return {{"joints", {kTorsoNode, kNeckNode, kHeadNode}},
            {"inverseBindMatrices", matrices},
            {"skeleton", kTorsoNode}};
}

/// A small turn: half angles as tangents of yaw and pitch.
glm::vec4 turn(double yaw, double pitch) {
    const glm::dquat q = glm::normalize(glm::dquat(1.0, pitch, yaw, 0.0));
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
            static_cast<float>(q.w)};
}

/// Cubic keys with zero tangents: the bust eases from side to side, the head a little further.
Json add_animation(GltfBuffer& buffer) {
    const std::array<float, 5> times = {0.0F, 2.0F, 4.0F, 6.0F, 8.0F};
    const size_t input =
        buffer.add(std::span<const float>(times), kFloat, "SCALAR", GltfBuffer::kNone);
    buffer.set_range(input, {times.front()}, {times.back()});
    Json samplers = Json::array();
    Json channels = Json::array();
    const auto animate = [&](Node node, std::array<glm::vec4, 5> keys) {
        std::vector<glm::vec4> values;
        for (const glm::vec4 key : keys) {
            values.insert(values.end(), {glm::vec4(0.0F), key, glm::vec4(0.0F)});
        }
        const size_t output =
            buffer.add(std::span<const glm::vec4>(values), kFloat, "VEC4", GltfBuffer::kNone);
        samplers.push_back(
            {{"input", input}, {"output", output}, {"interpolation", "CUBICSPLINE"}});
        channels.push_back({{"sampler", samplers.size() - 1},
                            {"target", {{"node", static_cast<int>(node)}, {"path", "rotation"}}}});
    };
    const glm::vec4 rest = turn(0.0, 0.0);
    animate(kTorsoNode, {rest, turn(0.07, 0.0), turn(0.03, 0.0), turn(-0.06, 0.0), rest});
    animate(kHeadNode, {rest, turn(0.045, 0.008), turn(0.0, -0.006), turn(-0.045, 0.006), rest});
    return {{"name", "look_around"}, {"channels", channels}, {"samplers", samplers}};
}

Json materials(const std::vector<Part>& parts) {
    Json result = Json::array();
    for (const Part& part : parts) {
        result.push_back({{"name", part.name},
                          {"pbrMetallicRoughness",
                           {{"metallicFactor", 0.0}, {"roughnessFactor", part.roughness}}}});
    }
    return result;
}

/// Undoes what to_groom() did: the groom is Z up in centimetres.
Json groom_transform() {
    constexpr double kHalf = 0.70710678118654752;
    return {{"rotation", {-kHalf, 0.0, 0.0, kHalf}}, {"scale", {0.01, 0.01, 0.01}}};
}

Json hair_extension() {
    return {{"groom", "../grooms/long.hair"},
            {"motion", {{"bend_length", 0.08}, {"drag", 1.2}, {"hold", 0.35}}},
            {"upright", false},
            {"transform", groom_transform()},
            {"width", {{"root", 0.00011}, {"tip_scale", 0.35}}},
            {"material",
             {{"melanin", {{"eumelanin", 0.55}, {"pheomelanin", 0.45}}},
              {"color_variation", 0.18},
              {"roughness", 0.28},
              {"shift", 0.035}}}};
}

Json brows_extension() {
    return {{"groom", "../grooms/brows.hair"},
            {"upright", false},
            {"transform", groom_transform()},
            {"width", {{"root", 0.00013}, {"tip_scale", 0.2}}},
            {"material",
             {{"melanin", {{"eumelanin", 3.0}, {"pheomelanin", 0.6}}}, {"roughness", 0.45}}}};
}

void add_colliders(Json& nodes) {
    for (const BodyCapsule& capsule : body_capsules()) {
        const bool head = capsule.part == BodyPart::kHead;
        const bool neck = capsule.part == BodyPart::kNeck;
        nodes[head ? kHeadNode : neck ? kNeckNode : kTorsoNode]["children"].push_back(nodes.size());
        nodes.push_back(collider_node(capsule, head ? kHead : neck ? kNeck : kTorso));
    }
}

Json nodes() {
    const dvec3 target = kBust + dvec3(0.0, -0.062, 0.0);
    const dvec3 eye = target + glm::normalize(dvec3(0.50, 0.07, 0.86)) * 1.05;
    const dvec3 rim = kBust + dvec3(-0.85, 0.45, -0.75);
    const auto hair = [](const char* name, const Json& extension) -> Json {
        return {{"name", name},
                {"translation", list(-kHead)},
                {"extensions", {{"VELLUS_hair", extension}}}};
    };
    const auto light = [](const char* name, int index, dvec3 place, dvec3 direction) -> Json {
        return {{"name", name},
                {"translation", list(place)},
                {"rotation", list(facing(direction))},
                {"extensions", {{"KHR_lights_punctual", {{"light", index}}}}}};
    };
    Json result = Json::array();
    result.push_back({{"name", "bust"}, {"translation", list(kBust)}, {"children", {kTorsoNode}}});
    result.push_back({{"name", "torso"}, {"translation", list(kTorso)}, {"children", {kNeckNode}}});
    result.push_back(
        {{"name", "neck"}, {"translation", list(kNeck - kTorso)}, {"children", {kHeadNode}}});
    result.push_back({{"name", "head"},
                      {"translation", list(kHead - kNeck)},
                      {"children", {kHairNode, kBrowsNode}}});
    result.push_back(hair("hair", hair_extension()));
    result.push_back(hair("brows", brows_extension()));
    result.push_back({{"name", "skin"}, {"mesh", 0}, {"skin", 0}});
    result.push_back({{"name", "camera"},
                      {"translation", list(eye)},
                      {"rotation", list(facing(target - eye))},
                      {"camera", 0}});
    result.push_back(light("sun", 0, dvec3(0.0, 2.0, 0.0), -dvec3(0.45, 0.62, 0.64)));
    result.push_back(light("rim", 1, rim, kBust - rim));
    add_colliders(result);
    return result;
}

Json lights() {
    const Json sun = {
        {"name", "sun"}, {"type", "directional"}, {"color", {1.0, 0.95, 0.88}}, {"intensity", 2.5}};
    const Json rim = {{"name", "rim"},
                      {"type", "spot"},
                      {"color", {0.85, 0.92, 1.0}},
                      {"intensity", 2.2},
                      {"range", 4.0},
                      {"spot", {{"innerConeAngle", 0.28}, {"outerConeAngle", 0.42}}}};
    return Json::array({sun, rim});
}

}  // namespace

Portrait make_portrait(const std::vector<Part>& parts) {
    GltfBuffer buffer;
    Json primitives = Json::array();
    for (size_t i = 0; i < parts.size(); ++i) {
        primitives.push_back(add_part(buffer, parts[i], static_cast<int>(i)));
    }
    const Json skin = add_skin(buffer);
    const Json animation = add_animation(buffer);
    const Json camera = {{"name", "portrait"},
                         {"type", "perspective"},
                         {"perspective", {{"yfov", 0.44}, {"znear", 0.05}}}};
    Json gltf = {{"asset", {{"version", "2.0"}, {"generator", "vellus_make_assets"}}}};
    gltf["extensionsUsed"] = {"KHR_lights_punctual", "VELLUS_collider", "VELLUS_hair"};
    gltf["scene"] = 0;
    gltf["scenes"] =
        Json::array({{{"name", "portrait"},
                      {"nodes", {kBustNode, kMeshNode, kCameraNode, kSunNode, kRimNode}}}});
    gltf["nodes"] = nodes();
    gltf["meshes"] = Json::array({{{"name", "bust"}, {"primitives", primitives}}});
    gltf["materials"] = materials(parts);
    gltf["skins"] = Json::array({skin});
    gltf["animations"] = Json::array({animation});
    gltf["cameras"] = Json::array({camera});
    gltf["extensions"] = {{"KHR_lights_punctual", {{"lights", lights()}}}};
    gltf["accessors"] = buffer.accessors();
    gltf["bufferViews"] = buffer.views();
    gltf["buffers"] =
        Json::array({{{"uri", "portrait.bin"}, {"byteLength", buffer.bytes().size()}}});
    return {gltf.dump(1, ' ') + "\n", buffer.bytes()};
}

}  // namespace vellus::sculpt
