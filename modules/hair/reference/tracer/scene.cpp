#include "modules/hair/reference/tracer/scene.h"

#include "engine/platform/hash.h"

namespace vellus::hair::tracer {

namespace {

class Hasher {
  public:
    template <class T>
    void column(const std::vector<T>& values) {
        value(values.size());
        bytes(std::as_bytes(std::span(values)));
    }
    /// Of a type without padding.
    template <class... T>
    void value(const T&... values) {
        (bytes(std::as_bytes(std::span(&values, 1))), ...);
    }
    [[nodiscard]] uint64_t result() const { return hash_; }

  private:
    void bytes(std::span<const std::byte> data) { hash_ = fnv1a(data, hash_); }
    uint64_t hash_ = kHashSeed;
};

void add(Hasher& h, const Groom& g) {
    h.column(g.points);
    h.column(g.tangents);
    h.column(g.parameter);
    h.column(g.segment_point);
    h.column(g.segment_strand);
    h.column(g.segment_tint);
    h.value(g.base_color, g.tip_color, g.gradient_start, g.roughness, g.tilt, g.specular, g.eta,
            g.azimuthal, g.alpha, g.light.hair_shadow, g.light.multiple, g.light.environment);
}

void add(Hasher& h, const Mesh& m) {
    h.column(m.positions);
    h.column(m.normals);
    h.column(m.texcoords);
    h.column(m.colors);
    h.column(m.triangles);
    h.value(m.base_color, m.emissive, m.metallic, m.roughness, m.alpha_cutoff, m.texture,
            m.two_sided, m.mirrored);
}

}  // namespace

uint64_t hash(const Scene& scene) {
    Hasher h;
    h.value(scene.camera.axes, scene.camera.tan_half_fov, scene.camera.near_plane);
    h.value(scene.grooms.size(), scene.meshes.size(), scene.textures.size(), scene.lights.size());
    for (const Groom& groom : scene.grooms) add(h, groom);
    for (const Mesh& mesh : scene.meshes) add(h, mesh);
    for (const asset::ImageF& texture : scene.textures) h.column(texture.rgba);
    for (const Light& light : scene.lights) {
        h.value(light.sun, light.position, light.to_light, light.color, light.cone_scale,
                light.cone_offset);
    }
    if (scene.environment) {
        h.column(scene.environment->pixels.rgba);
        h.value(scene.environment->intensity, scene.environment->rotation);
    }
    return h.result();
}

}  // namespace vellus::hair::tracer
