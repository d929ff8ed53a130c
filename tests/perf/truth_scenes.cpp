#include "tests/perf/truth_scenes.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/grow/grow.h"

namespace vellus::bench {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr float kHeadRadius = 0.09f;
constexpr uint32_t kStrands = 10'000;
// As many strands again as stand on a head share the width: the same layers of hair for less time.
constexpr float kWidth = 0.00018f;
// From a little behind the ear, where most is hair.
constexpr double kCameraAzimuth = 115.0;
constexpr double kCameraElevation = 15.0;
constexpr double kCameraDistance = 0.9;
constexpr uint32_t kAround = 48;
constexpr uint32_t kRows = 24;

std::vector<std::byte> ball_bytes() {
    std::vector<float> vertices;
    std::vector<uint32_t> indices;
    for (uint32_t row = 0; row <= kRows; ++row) {
        for (uint32_t i = 0; i < kAround; ++i) {
            const float polar = std::numbers::pi_v<float> * row / kRows;
            const float azimuth = 2.0f * std::numbers::pi_v<float> * i / kAround;
            for (const float value : {std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                      std::sin(polar) * std::cos(azimuth)}) {
                vertices.push_back(value);
            }
        }
    }
    for (uint32_t row = 0; row < kRows; ++row) {
        for (uint32_t i = 0; i < kAround; ++i) {
            const uint32_t a = row * kAround + i;
            const uint32_t b = row * kAround + (i + 1) % kAround;
            for (const uint32_t v : {a, a + kAround, b, b, a + kAround, b + kAround}) {
                indices.push_back(v);
            }
        }
    }
    // Normals as they are, then positions, then triangles.
    std::vector<float> positions(vertices);
    for (float& value : positions) value *= 0.985f * kHeadRadius;
    std::vector<std::byte> bytes(4 * (2 * vertices.size() + indices.size()));
    std::memcpy(bytes.data(), vertices.data(), 4 * vertices.size());
    std::memcpy(bytes.data() + 4 * vertices.size(), positions.data(), 4 * vertices.size());
    std::memcpy(bytes.data() + 8 * vertices.size(), indices.data(), 4 * indices.size());
    return bytes;
}

/// Bright above, dim below, warm and cool enough that channels do not hide each other.
asset::ImageF sky_image() {
    asset::ImageF image{.width = 32, .height = 16, .rgba = {}};
    for (uint32_t y = 0; y < image.height; ++y) {
        const float up = 1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / 16.0f;
        const float share = 0.5f + 0.5f * std::tanh(4.0f * up);
        for (uint32_t x = 0; x < image.width; ++x) {
            for (const float value :
                 {0.25f + 0.65f * share, 0.25f + 0.75f * share, 0.2f + 1.0f * share, 1.0f}) {
                image.rgba.push_back(value);
            }
        }
    }
    return image;
}

/// Unit, by degrees around the head from the camera (counter-clockwise seen from above) and
/// upwards.
glm::dvec3 direction(double azimuth, double elevation) {
    const double a = glm::radians(azimuth + kCameraAzimuth);
    const double e = glm::radians(elevation);
    return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

/// Turns a node's +Z, against which cameras look and lights shine, without rolling it.
json rotation_to(const glm::dvec3& d) {
    const glm::dquat q = glm::angleAxis(std::atan2(d.x, d.z), glm::dvec3(0, 1, 0)) *
                         glm::angleAxis(-std::asin(d.y), glm::dvec3(1, 0, 0));
    return {q.x, q.y, q.z, q.w};
}

json material_of(const std::string& colour) {
    json material = {{"roughness", 0.3}};
    if (colour == "white") {
        material["base_color"] = {0.92, 0.92, 0.92};
        return material;
    }
    const double eumelanin = colour == "black" ? 8.0 : colour == "brown" ? 1.3 : 0.3;
    material["melanin"] = {{"eumelanin", eumelanin}};
    return material;
}

json ball_buffers() {
    constexpr uint32_t kVertices = (kRows + 1) * kAround;
    constexpr uint32_t kIndices = 6 * kRows * kAround;
    const double r = 0.985 * static_cast<double>(kHeadRadius);
    return {
        {"buffers", {{{"uri", "ball.bin"}, {"byteLength", 24 * kVertices + 4 * kIndices}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 12 * kVertices}},
          {{"buffer", 0}, {"byteOffset", 12 * kVertices}, {"byteLength", 12 * kVertices}},
          {{"buffer", 0}, {"byteOffset", 24 * kVertices}, {"byteLength", 4 * kIndices}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", 5126}, {"count", kVertices}, {"type", "VEC3"}},
          {{"bufferView", 1},
           {"componentType", 5126},
           {"count", kVertices},
           {"type", "VEC3"},
           {"min", {-r, -r, -r}},
           {"max", {r, r, r}}},
          {{"bufferView", 2}, {"componentType", 5125}, {"count", kIndices}, {"type", "SCALAR"}}}}};
}

glm::dvec3 to_sun(const std::string& light) {
    if (light == "front") return direction(25.0, 15.0);
    if (light == "side") return direction(-85.0, 25.0);
    return direction(160.0, 25.0);
}

}  // namespace

Result<void> write_truth_files(const fs::path& folder) {
    for (const std::string_view style : kTruthGrooms) {
        const fs::path path = folder / (std::string(style) + ".hair");
        if (fs::exists(path)) continue;
        const auto found = hair::grow_style(style);
        if (!found) return found.error();
        hair::GrowSettings settings = hair::preset(*found);
        settings.count = kStrands;
        settings.width = kWidth;
        settings.length = 0.2f;
        settings.frizz = 0.5f;
        const auto groom = hair::grow_groom(
            hair::sphere_surface(glm::vec3(0.0f), kHeadRadius, false), settings, 7);
        if (!groom) return groom.error();
        if (auto saved = hair::save_groom(*groom, path); !saved) return saved;
    }
    const auto ball = ball_bytes();
    if (auto saved = write_file(folder / "ball.bin", std::span<const std::byte>(ball)); !saved) {
        return saved;
    }
    return asset::save_exr(folder / "sky.exr", sky_image());
}

Result<fs::path> write_truth_scene(const fs::path& folder, const TruthCase& which) {
    const bool sky = which.light == "sky";
    json scene = ball_buffers();
    scene["asset"] = {{"version", "2.0"}};
    scene["scene"] = 0;
    scene["extensionsUsed"] = {"VELLUS_hair", "VELLUS_environment", "KHR_lights_punctual"};
    scene["materials"] = {{{"pbrMetallicRoughness",
                            {{"baseColorFactor", {0.12, 0.12, 0.12, 1.0}},
                             {"metallicFactor", 0.0},
                             {"roughnessFactor", 1.0}}}}};
    scene["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"NORMAL", 0}, {"POSITION", 1}}}, {"indices", 2}, {"material", 0}}}}}};
    scene["cameras"] = {{{"type", "perspective"},
                         {"perspective", {{"yfov", 0.42}, {"znear", 0.05}, {"aspectRatio", 1.0}}}}};
    const json hair = {{"groom", which.groom + ".hair"},
                       {"upright", false},
                       {"material", material_of(which.colour)}};
    const glm::dvec3 eye = direction(0.0, kCameraElevation);
    const glm::dvec3 at = kCameraDistance * eye + glm::dvec3(0.0, -0.045, 0.0);
    scene["nodes"] = json::array({{{"name", "head"}, {"mesh", 0}},
                                  {{"name", "hair"}, {"extensions", {{"VELLUS_hair", hair}}}},
                                  {{"name", "camera"},
                                   {"camera", 0},
                                   {"translation", {at.x, at.y, at.z}},
                                   {"rotation", rotation_to(eye)}},
                                  {{"name", "sun"},
                                   {"rotation", rotation_to(to_sun(which.light))},
                                   {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}});
    scene["extensions"] = {
        {"KHR_lights_punctual",
         {{"lights", {{{"type", "directional"}, {"intensity", sky ? 0.0 : 3.0}}}}}}};
    scene["scenes"] = {
        {{"nodes", {0, 1, 2, 3}},
         {"extensions",
          {{"VELLUS_environment", {{"image", "sky.exr"}, {"intensity", sky ? 1.0 : 0.0}}}}}}};
    const fs::path path = folder / (which.name() + ".gltf");
    if (auto saved = write_file(path, std::string_view(scene.dump(1))); !saved) {
        return saved.error();
    }
    return path;
}

}  // namespace vellus::bench
