#include "game_demo/src/ground.h"

#include "modules/scene/library.h"

namespace vellus::demo {

Ground::Ground(World& world) {
    const auto& library = world.resource<scene::SceneLibrary>();
    world.query<const scene::MeshInstance, const scene::WorldTransform>().each(
        [&](const scene::MeshInstance& instance, const scene::WorldTransform& transform) {
            if (instance.skin != asset::kNone) return;
            const asset::SceneAsset& scene = *library.assets[instance.asset];
            for (const asset::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
                if (primitive.topology != asset::Topology::kTriangles) continue;
                const auto corner = [&](size_t i) {
                    const uint32_t vertex = primitive.indices[i];
                    return glm::dvec3(transform.matrix *
                                      glm::dvec4(primitive.positions[vertex], 1.0));
                };
                for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                    add(corner(i), corner(i + 1), corner(i + 2));
                }
            }
        });
}

std::optional<double> Ground::height(double x, double z, double highest) const {
    std::optional<double> found;
    for (const auto& [a, b, c] : triangles_) {
        // Barycentric coordinates in the plan, whose area is zero for walls.
        const double area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
        if (area == 0.0) continue;
        const double u = ((x - a.x) * (c.z - a.z) - (c.x - a.x) * (z - a.z)) / area;
        const double v = ((b.x - a.x) * (z - a.z) - (x - a.x) * (b.z - a.z)) / area;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        const double y = a.y + u * (b.y - a.y) + v * (c.y - a.y);
        if (y <= highest && (!found || y > *found)) found = y;
    }
    return found;
}

}  // namespace vellus::demo
