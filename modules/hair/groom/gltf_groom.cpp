#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "modules/hair/groom/groom_file.h"

// Grooms in glTF: each LINE_STRIP primitive is one strand, as is each run of joined LINES.
// COLOR_0 is colour and opacity, TEXCOORD_0 the texture coordinate, _THICKNESS the diameter.
namespace vellus::hair {

namespace {

using asset::Primitive;
using asset::Topology;

/// World matrix of a node in the rest pose; gives up at a cycle of parents.
glm::mat4 world_matrix(const asset::SceneAsset& scene, uint32_t node) {
    glm::mat4 world(1.0f);
    for (size_t steps = 0; node < scene.nodes.size() && steps < scene.nodes.size(); ++steps) {
        const asset::Node& at = scene.nodes[node];
        const glm::mat4 local = glm::translate(glm::mat4(1.0f), at.translation) *
                                glm::mat4_cast(at.rotation) * glm::scale(glm::mat4(1.0f), at.scale);
        world = local * world;
        node = at.parent;
    }
    return world;
}

/// Columns of a groom under construction; an optional column appears with its first value.
class Collector {
  public:
    explicit Collector(Groom& groom) : groom_(groom) {}

    void add(const Primitive& primitive, const glm::mat4& world) {
        placed_ = world != glm::mat4(1.0f);
        world_ = world;
        scale_ = std::cbrt(std::abs(glm::determinant(glm::mat3(world))));
        if (primitive.topology == Topology::kLineStrip) {
            add_strip(primitive);
        } else {
            add_lines(primitive);
        }
    }

  private:
    static uint32_t count(const Primitive& p) {
        return static_cast<uint32_t>(p.indices.empty() ? p.positions.size() : p.indices.size());
    }
    static uint32_t index(const Primitive& p, uint32_t i) {
        return p.indices.empty() ? i : p.indices[i];
    }

    void add_strip(const Primitive& primitive) {
        for (uint32_t i = 0; i < count(primitive); ++i) add_point(primitive, index(primitive, i));
        end_strand();
    }

    void add_lines(const Primitive& primitive) {
        uint32_t last = asset::kNone;
        for (uint32_t i = 0; i + 1 < count(primitive); i += 2) {
            const uint32_t from = index(primitive, i);
            if (from != last) {
                end_strand();
                add_point(primitive, from);
            }
            last = index(primitive, i + 1);
            add_point(primitive, last);
        }
        end_strand();
    }

    void add_point(const Primitive& primitive, uint32_t i) {
        if (i >= primitive.positions.size()) return;
        const glm::vec3 point = primitive.positions[i];
        const size_t before = groom_.points.size();
        groom_.points.push_back(placed_ ? glm::vec3(world_ * glm::vec4(point, 1.0f)) : point);
        if (i < primitive.thickness.size()) {
            const float thickness = primitive.thickness[i];
            groom_.thickness.resize(before, 0.0f);
            groom_.thickness.push_back(placed_ ? thickness * scale_ : thickness);
        }
        if (i < primitive.colors.size()) {
            groom_.colors.resize(before, glm::vec4(1.0f));
            groom_.colors.push_back(primitive.colors[i]);
        }
        if (i < primitive.texcoords.size()) {
            groom_.point_uvs.resize(before, glm::vec2(0.0f));
            groom_.point_uvs.push_back(primitive.texcoords[i]);
        }
    }

    void end_strand() {
        if (groom_.strand_begin.back() == groom_.points.size()) return;
        groom_.strand_begin.push_back(static_cast<uint32_t>(groom_.points.size()));
    }

    Groom& groom_;
    glm::mat4 world_{1.0f};
    bool placed_ = false;
    float scale_ = 1.0f;
};

bool is_lines(const Primitive& primitive) {
    return primitive.topology == Topology::kLineStrip || primitive.topology == Topology::kLines;
}

/// Where every strand keeps one texture coordinate, that is its root's.
void move_uvs_to_strands(Groom& groom) {
    if (groom.point_uvs.empty()) return;
    std::vector<glm::vec2> uvs(groom.strand_count());
    for (size_t strand = 0; strand < uvs.size(); ++strand) {
        const auto first = groom.point_uvs.begin() + groom.strand_begin[strand];
        const auto last = groom.point_uvs.begin() + groom.strand_begin[strand + 1];
        uvs[strand] = *first;
        if (std::any_of(first, last, [&](glm::vec2 uv) { return uv != *first; })) return;
    }
    groom.strand_uvs = std::move(uvs);
    groom.point_uvs.clear();
}

void fill_columns(Groom& groom) {
    const size_t points = groom.points.size();
    if (!groom.thickness.empty()) groom.thickness.resize(points, 0.0f);
    if (!groom.colors.empty()) groom.colors.resize(points, glm::vec4(1.0f));
    if (!groom.point_uvs.empty()) groom.point_uvs.resize(points, glm::vec2(0.0f));
    move_uvs_to_strands(groom);
}

void take_material(const asset::SceneAsset& scene, const Primitive& primitive, Groom& groom) {
    if (groom.has_default_color || primitive.material >= scene.materials.size()) return;
    groom.default_color = glm::vec3(scene.materials[primitive.material].base_color);
    groom.has_default_color = true;
}

}  // namespace

Result<Groom> groom_from_scene(const asset::SceneAsset& scene, const std::string& where) {
    Groom groom;
    groom.format = GroomFormat::kGltf;
    Collector collector(groom);
    const auto add_mesh = [&](uint32_t mesh, const glm::mat4& world) {
        if (mesh >= scene.meshes.size()) return;
        for (const Primitive& primitive : scene.meshes[mesh].primitives) {
            if (!is_lines(primitive)) continue;
            collector.add(primitive, world);
            take_material(scene, primitive, groom);
        }
    };
    for (uint32_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh < scene.meshes.size()) {
            add_mesh(scene.nodes[node].mesh, world_matrix(scene, node));
        }
    }
    if (scene.nodes.empty()) {
        for (uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) add_mesh(mesh, glm::mat4(1.0f));
    }
    if (groom.points.empty()) {
        return Error{"has no line strips, so no strands", where,
                     "give a glTF whose meshes are LINE_STRIP or LINES primitives"};
    }
    fill_columns(groom);
    return groom;
}

}  // namespace vellus::hair
