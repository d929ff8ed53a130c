#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string>
#include <vector>

#include "engine/asset/image.h"

// What a glTF 2.0 file says, as plain data: metres, seconds, radians, Y up, right-handed.
// Indices refer to the vectors of SceneAsset; kNone means "not given".
namespace vellus::asset {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

/// One JSON extension object the engine itself does not know, for the module that does.
struct Extension {
    std::string name;
    std::string json;
};

struct Node {
    std::string name;
    uint32_t parent = kNone;
    std::vector<uint32_t> children;
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    uint32_t mesh = kNone;
    uint32_t skin = kNone;
    uint32_t camera = kNone;
    uint32_t light = kNone;
    std::vector<float> morph_weights;
    std::vector<Extension> extensions;
};

enum class Topology : uint8_t { kPoints, kLines, kLineStrip, kTriangles };

/// Displacements of one morph target; empty where the file gives none.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

/// One more attribute of the vertices: custom (_NAME) or a further colour set (COLOR_1 and on);
/// `components` floats for each.
struct VertexColumn {
    std::string name;
    uint32_t components = 1;
    std::vector<float> values;
};

/// One draw: attributes are empty or as long as `positions`; strips and fans come as plain
/// triangles, line loops as closed line strips. `indices` is always filled and in range. Triangles
/// always have unit normals. Weights are >= 0 and sum to 1; a joint without weight is 0.
struct Primitive {
    Topology topology = Topology::kTriangles;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texcoords;
    std::vector<glm::vec4> colors;
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights;
    /// The custom attribute _THICKNESS: a strand's diameter.
    std::vector<float> thickness;
    std::vector<VertexColumn> columns;
    std::vector<uint32_t> indices;
    std::vector<MorphTarget> morph_targets;
    uint32_t material = kNone;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> morph_weights;
};

enum class AlphaMode : uint8_t { kOpaque, kMask, kBlend };

/// Metallic-roughness material; textures are indices into `images`, never of an image that could
/// not be decoded.
struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};
    float metallic = 1.0f;
    float roughness = 1.0f;
    glm::vec3 emissive{0.0f};
    uint32_t base_color_image = kNone;
    uint32_t metallic_roughness_image = kNone;
    uint32_t normal_image = kNone;
    AlphaMode alpha_mode = AlphaMode::kOpaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
};

struct Skin {
    std::string name;
    std::vector<uint32_t> joints;
    std::vector<glm::mat4> inverse_bind;
};

enum class AnimationPath : uint8_t { kTranslation, kRotation, kScale, kWeights };
enum class Interpolation : uint8_t { kLinear, kStep, kCubicSpline };

/// Keys of one property of one node. `values` holds `width` floats per key (three times that for
/// kCubicSpline: in-tangent, value, out-tangent); rotations are x, y, z, w.
struct AnimationChannel {
    uint32_t node = kNone;
    AnimationPath path = AnimationPath::kTranslation;
    Interpolation interpolation = Interpolation::kLinear;
    uint32_t width = 3;
    std::vector<float> times;
    std::vector<float> values;
};

struct Animation {
    std::string name;
    float duration = 0.0f;
    std::vector<AnimationChannel> channels;
};

struct Camera {
    std::string name;
    bool perspective = true;
    float vertical_fov = 0.8f;
    float aspect = 0.0f;
    float near_plane = 0.1f;
    float far_plane = 0.0f;
    glm::vec2 half_extent{1.0f};
};

enum class LightKind : uint8_t { kDirectional, kPoint, kSpot };

/// KHR_lights_punctual: candela for point and spot, lux for directional; shines along -Z.
struct Light {
    std::string name;
    LightKind kind = LightKind::kDirectional;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;
    float range = 0.0f;
    float inner_cone = 0.0f;
    float outer_cone = 0.785398f;
};

/// `roots` are those of the default scene (else of the first, else every node without parent);
/// nodes outside it are kept. `extensions` are the scene's. `images` keeps the file's order: one
/// that could not be decoded is empty. `warnings` has a line for everything repaired or left out.
struct SceneAsset {
    std::filesystem::path path;
    std::vector<Node> nodes;
    std::vector<uint32_t> roots;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<Extension> extensions;
    std::vector<std::string> warnings;
};

}  // namespace vellus::asset
