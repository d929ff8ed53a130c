#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/asset/image.h"

/// What the path tracer draws, as plain columns: metres, relative to the camera, axes of the world.
namespace vellus::hair::tracer {

constexpr uint32_t kNone = ~0u;

/// At the origin; columns of `axes` are right, up and back.
struct Camera {
    glm::dmat3 axes{1.0};
    glm::dvec2 tan_half_fov{0.4, 0.4};  ///< horizontal, vertical
    double near_plane = 0.05;           ///< metres along the view axis; nothing nearer is seen
};

/// Which light a groom takes part in; all of it unless a technique is switched off.
struct GroomLight {
    bool hair_shadow = true;  ///< hair stands between punctual lights and this groom
    bool multiple = true;     ///< light that other things scattered
    bool environment = true;
};

/// A groom's strands and fibres.
struct Groom {
    std::vector<glm::vec4> points;    ///< position, radius in metres
    std::vector<glm::vec3> tangents;  ///< by point: unit, root to tip, smooth
    std::vector<float> parameter;     ///< by point: 0 at the root to 1 at the tip
    std::vector<uint32_t> segment_point;
    std::vector<uint32_t> segment_strand;
    std::vector<glm::vec3> segment_tint;  ///< colours of file and strand
    glm::vec3 base_color{0.5f};           ///< C = e^(-4 σ_a), see hair/scattering/melanin.glsl
    glm::vec3 tip_color{0.5f};
    float gradient_start = 0.0f;
    float roughness = 0.3f;
    float tilt = 0.0f;  ///< radians
    float specular = 1.0f;
    float eta = 1.55f;
    float azimuthal = 1.0f;  ///< factor on the azimuthal widths of TT and TRT
    float alpha = 1.0f;
    GroomLight light;
};

/// Triangles of one material, already deformed.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texcoords;  ///< empty: (0, 0)
    std::vector<glm::vec4> colors;     ///< empty: white
    std::vector<glm::uvec3> triangles;
    glm::vec4 base_color{1.0f};
    glm::vec3 emissive{0.0f};
    float metallic = 0.0f;
    float roughness = 1.0f;
    float alpha_cutoff = 0.0f;  ///< 0: opaque; negative: alpha is the share of rays that hit
    uint32_t texture = kNone;   ///< base colour, into Scene::textures
    bool two_sided = false;
    bool mirrored = false;  ///< its triangles turn the other way
};

/// Sun, spot or point with the falloff of shaders/light/lights.glsl.
struct Light {
    bool sun = true;
    glm::dvec3 position{0.0};
    glm::dvec3 to_light{0.0, 1.0, 0.0};  ///< unit: towards a sun; against the axis of a spot
    glm::dvec3 color{0.0};               ///< sun: irradiance; others: irradiance at 1 m
    double cone_scale = 0.0;
    double cone_offset = 1.0;
};

struct Environment {
    asset::ImageF pixels;  ///< equirectangular (shaders/light/equirect.glsl)
    double intensity = 1.0;
    double rotation = 0.0;  ///< radians about +Y, counter-clockwise from above
};

struct Scene {
    Camera camera;
    std::vector<Groom> grooms;
    std::vector<Mesh> meshes;
    std::vector<asset::ImageF> textures;  ///< linear
    std::vector<Light> lights;
    std::optional<Environment> environment;
};

/// Fingerprint of all that decides the picture.
uint64_t hash(const Scene& scene);

}  // namespace vellus::hair::tracer
