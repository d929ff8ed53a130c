#include "game_demo/tools/reference/gather_scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/asset/image_io.h"
#include "game_demo/tools/reference/gather_hair.h"
#include "modules/character/deform.h"
#include "modules/character/reference/skin.h"
#include "modules/scene/library.h"
#include "modules/scene/view.h"

namespace vellus::demo {

namespace {

namespace tracer = hair::tracer;

tracer::Camera camera_of(const scene::CameraPose& pose, const glm::uvec2& size) {
    const double tan_half = std::tan(0.5 * static_cast<double>(pose.vertical_fov));
    return {.axes = pose.axes,
            .tan_half_fov = {tan_half * size.x / size.y, tan_half},
            .near_plane = pose.near_plane};
}

/// Textures of the tracer's scene by asset and image, each converted once.
class Textures {
  public:
    explicit Textures(std::vector<asset::ImageF>& list) : list_(list) {}

    uint32_t find(const asset::SceneAsset& scene, uint32_t image) {
        if (image >= scene.images.size() || scene.images[image].rgba.empty()) return tracer::kNone;
        const auto [place, added] =
            known_.try_emplace(&scene.images[image], static_cast<uint32_t>(list_.size()));
        if (added) list_.push_back(asset::to_linear(scene.images[image]));
        return place->second;
    }

  private:
    std::vector<asset::ImageF>& list_;
    std::map<const asset::Image*, uint32_t> known_;
};

void set_material(const asset::Material& material, tracer::Mesh& mesh) {
    mesh.base_color = material.base_color;
    mesh.emissive = material.emissive;
    mesh.metallic = material.metallic;
    mesh.roughness = material.roughness;
    mesh.two_sided = material.double_sided;
    if (material.alpha_mode == asset::AlphaMode::kMask) {
        mesh.alpha_cutoff = std::max(material.alpha_cutoff, 1e-6f);
    }
    if (material.alpha_mode == asset::AlphaMode::kBlend) mesh.alpha_cutoff = -1.0f;
}

tracer::Mesh make_mesh(const asset::Primitive& primitive, std::span<const glm::dmat4> palette,
                       std::span<const float> weights, const glm::dvec3& camera) {
    tracer::Mesh mesh;
    const auto skinned = character::reference::skin(primitive, palette, weights);
    for (const glm::dvec3& p : skinned.positions) mesh.positions.emplace_back(p - camera);
    for (const glm::dvec3& n : skinned.normals) mesh.normals.emplace_back(n);
    mesh.texcoords = primitive.texcoords;
    mesh.colors = primitive.colors;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        mesh.triangles.emplace_back(primitive.indices[i], primitive.indices[i + 1],
                                    primitive.indices[i + 2]);
    }
    mesh.mirrored = glm::determinant(glm::dmat3(palette[0])) < 0.0;
    return mesh;
}

void gather_meshes(World& world, const glm::dvec3& camera, tracer::Scene& scene) {
    const auto& library = world.resource<scene::SceneLibrary>();
    const auto& columns = world.resource<character::DeformColumns>();
    Textures textures(scene.textures);
    world.query<const scene::MeshInstance, const character::MeshSlot>().each(
        [&](const scene::MeshInstance& instance, const character::MeshSlot& slot) {
            const asset::SceneAsset& asset = *library.assets[instance.asset];
            const auto palette =
                std::span(columns.palette).subspan(slot.first_joint, slot.joint_count);
            const auto weights =
                std::span(columns.weights).subspan(slot.first_weight, slot.weight_count);
            for (const asset::Primitive& primitive : asset.meshes[instance.mesh].primitives) {
                if (primitive.topology != asset::Topology::kTriangles) continue;
                if (primitive.indices.empty()) continue;
                tracer::Mesh mesh = make_mesh(primitive, palette, weights, camera);
                const asset::Material material = primitive.material < asset.materials.size()
                                                     ? asset.materials[primitive.material]
                                                     : asset::Material{};
                set_material(material, mesh);
                mesh.texture = textures.find(asset, material.base_color_image);
                scene.meshes.push_back(std::move(mesh));
            }
        });
}

/// As light_set.cpp describes it to the shaders; here no light is one too many.
tracer::Light make_light(const scene::Light& source, const glm::dmat4& world,
                         const glm::dvec3& camera) {
    tracer::Light light;
    light.sun = source.kind == asset::LightKind::kDirectional;
    light.position = glm::dvec3(world[3]) - camera;
    light.to_light = glm::normalize(glm::dvec3(world[2]));
    light.color = glm::max(glm::dvec3(source.color) * static_cast<double>(source.intensity), 0.0);
    if (source.kind == asset::LightKind::kSpot) {
        // KHR_lights_punctual, "Inner and Outer Cone Angles".
        const double outer = std::cos(source.outer_cone);
        const double inner = std::cos(std::min(source.inner_cone, source.outer_cone));
        light.cone_scale = 1.0 / std::max(inner - outer, 1e-3);
        light.cone_offset = -outer * light.cone_scale;
    }
    return light;
}

}  // namespace

tracer::Scene gather_scene(CpuHost& host) {
    World& world = host.world();
    const scene::CameraPose& pose = world.resource<scene::ViewState>().pose;
    tracer::Scene scene;
    scene.camera = camera_of(pose, world.resource<scene::ViewSettings>().size);
    gather_hair(host, pose.position, scene.grooms);
    gather_meshes(world, pose.position, scene);
    world.query<const scene::Light, const scene::WorldTransform>().each(
        [&](const scene::Light& light, const scene::WorldTransform& placed) {
            scene.lights.push_back(make_light(light, placed.matrix, pose.position));
        });
    const light::EnvironmentImage& environment = host.environment();
    if (!environment.pixels.rgba.empty()) {
        scene.environment = {environment.pixels, environment.intensity, environment.rotation};
    }
    return scene;
}

}  // namespace vellus::demo
