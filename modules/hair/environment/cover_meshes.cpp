#include "modules/hair/environment/cover_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <optional>

#include "modules/hair/binding/bound_roots.h"
#include "modules/hair/binding/components.h"
#include "modules/hair/binding/rest_target.h"
#include "modules/hair/cards/card_groom.h"
#include "modules/hair/environment/ambient.h"
#include "modules/hair/environment/mesh_cover.h"
#include "modules/hair/geometry/groom_colors.h"
#include "modules/scene/library.h"

namespace vellus::hair {

namespace {

constexpr float kLeastCover = 0.004f;  // a step of eight bits
constexpr float kMeanCosine = 0.785f;  // of inclinations, over all directions

bool covers(const HairTechniques& techniques, const HairMaterial& material) {
    return techniques.environment == EnvironmentTechnique::kShDepth && material.alpha > 0.0f;
}

/// Where an entity hangs: in which scene, and below which joint.
struct Place {
    uint32_t instance = asset::kNone;
    uint32_t joint = asset::kNone;

    bool operator==(const Place&) const = default;
};

bool is_joint(const asset::SceneAsset& scene, uint32_t node) {
    return std::ranges::any_of(scene.skins, [&](const asset::Skin& skin) {
        return std::ranges::find(skin.joints, node) != skin.joints.end();
    });
}

Place place_of(const World& world, Entity entity) {
    const auto& library = world.resource<scene::SceneLibrary>();
    Place place;
    for (Entity at = entity; at != kNoEntity;) {
        if (const auto* root = world.get<scene::InstanceRoot>(at)) place.instance = root->instance;
        if (const auto* ref = world.get<scene::NodeRef>(at)) {
            place.instance = ref->instance;
            const auto& scene = library.asset_of(library.instances[ref->instance]);
            if (is_joint(scene, ref->node)) {
                place.joint = ref->node;
                break;
            }
        }
        const auto* up = world.get<scene::Parent>(at);
        at = up == nullptr ? kNoEntity : up->entity;
    }
    return place;
}

/// Whether hair lies on the mesh of an entity, or moves as that does.
bool moves_with(const World& world, Entity hair, Entity mesh) {
    const auto* ref = world.get<scene::NodeRef>(mesh);
    if (ref == nullptr) return false;
    const uint32_t skin = world.get<scene::MeshInstance>(mesh)->skin;
    if (const auto* binding = world.get<HairBinding>(hair)) {
        const auto* carrier = world.get<scene::NodeRef>(binding->mesh);
        return mesh == binding->mesh ||
               (skin != asset::kNone && carrier != nullptr && carrier->instance == ref->instance &&
                world.get<scene::MeshInstance>(binding->mesh)->skin == skin);
    }
    const Place place = place_of(world, hair);
    if (place.instance != ref->instance) return false;
    if (skin == asset::kNone) return place == place_of(world, mesh);
    const auto& library = world.resource<scene::SceneLibrary>();
    const auto& joints = library.asset_of(library.instances[ref->instance]).skins[skin].joints;
    return std::ranges::find(joints, place.joint) != joints.end();
}

CoverPart part_of(const World& world, const RestTarget& target, Entity hair) {
    const auto* binding = world.get<HairBinding>(hair);
    return {.groom = world.get<Hair>(hair)->groom,
            .placement = binding == nullptr
                             ? placement_at_rest(world, target, hair)
                             : world.resource<HairBindings>().list[binding->roots].roots.placement,
            .tip_scale = world.get<HairWidth>(hair)->tip_scale};
}

/// Cards whose volume is gone stop nothing: they cover what is there when they are first drawn.
std::optional<AmbientVolume> volume_of(const LibraryGroom& groom, float tip_scale) {
    if (groom.volume != nullptr) return *groom.volume;
    if (groom.cards || groom.positions.empty()) return std::nullopt;
    const float root = groom.width > 0.0f ? groom.width : kNominalWidth;
    return ambient_volume({groom.positions, groom.strand_begin}, StrandTaper{root, tip_scale});
}

/// As `m` turns it, as long as before.
glm::vec3 turned(const glm::dmat3& m, const glm::vec3& v) {
    const glm::dvec3 moved = m * glm::dvec3(v);
    const double length = glm::length(moved);
    return length > 0.0 ? glm::vec3(moved * (static_cast<double>(glm::length(v)) / length))
                        : glm::vec3(0.0f);
}

character::CoveredVertex pack(const SkyAtVertex& sky, const BoundVertex& vertex,
                              std::span<const glm::dmat4> palette) {
    glm::dmat4 m(0.0);
    for (int k = 0; k < 4; ++k) {
        m += static_cast<double>(vertex.weights[k]) * palette[vertex.joints[k]];
    }
    const glm::vec3 lean = turned(glm::inverse(glm::dmat3(m)), sky.lean);
    return {glm::packSnorm4x8(glm::vec4(0.5f * lean, sky.open)), sky.depth};
}

/// Of all vertices, in the order in which those of drawn primitives lie on the device.
Result<gpu::Buffer> upload(gpu::Device& device, const asset::Mesh& mesh, const RestMesh& rest,
                           std::span<const glm::dmat4> palette, std::span<const SkyAtVertex> skies,
                           uint64_t& primitives) {
    std::vector<character::CoveredVertex> packed;
    size_t first = 0;
    uint32_t index = 0;
    for (const asset::Primitive& primitive : mesh.primitives) {
        if (primitive.topology != asset::Topology::kTriangles) continue;
        const size_t end = first + primitive.positions.size();
        if (!primitive.indices.empty()) {
            for (size_t v = first; v < end; ++v) {
                packed.push_back(pack(skies[v], rest.vertices[v], palette));
                const float hidden = (1.0f - skies[v].open) * (1.0f - std::exp(-skies[v].depth));
                if (hidden > kLeastCover) primitives |= uint64_t{1} << std::min(index, 63U);
            }
            ++index;
        }
        first = end;
    }
    if (primitives == 0) return gpu::Buffer();
    return gpu::Buffer::upload_span(device, std::span<const character::CoveredVertex>(packed),
                                    "sky cover");
}

std::vector<glm::vec3> to_floats(const std::vector<glm::dvec3>& values) {
    return {values.begin(), values.end()};
}

Result<void> work_out(World& world, const RestTarget& target, uint32_t mesh, Cover& cover) {
    cover.amounts.assign(cover.parts.size(), 0.0f);
    auto rest = target.at_rest();
    if (!rest) return {};  // nothing to draw, nothing to cover
    std::vector<CoveringGroom> grooms;
    std::vector<size_t> part_of_groom;
    for (size_t i = 0; i < cover.parts.size(); ++i) {
        const CoverPart& part = cover.parts[i];
        const auto& groom = world.resource<HairLibrary>().grooms[part.groom];
        auto volume = volume_of(groom, part.tip_scale);
        if (!volume) continue;
        grooms.push_back({*std::move(volume), glm::mat4(glm::inverse(part.placement))});
        part_of_groom.push_back(i);
    }
    const auto positions = to_floats(rest->positions);
    const auto normals = to_floats(rest->normals);
    const MeshCover found = mesh_cover({positions, normals, rest->triangles}, grooms);
    for (size_t g = 0; g < grooms.size(); ++g) cover.amounts[part_of_groom[g]] = found.amounts[g];
    auto buffer = upload(*world.resource<scene::RenderFrame>().device, target.asset->meshes[mesh],
                         *rest, target.palette(), found.vertices, cover.primitives);
    if (!buffer) return buffer.error();
    cover.vertices = *std::move(buffer);
    return {};
}

/// The place of such a cover among those known, made where it is new.
Result<size_t> find_cover(World& world, const RestTarget& target, uint32_t mesh,
                          std::vector<CoverPart> parts) {
    auto& list = world.resource<HairCovers>().covers;
    const auto known = std::ranges::find_if(list, [&](const Cover& cover) {
        return cover.asset == target.asset_index && cover.mesh == target.mesh &&
               cover.parts == parts;
    });
    if (known != list.end()) return static_cast<size_t>(known - list.begin());
    Cover cover{.asset = target.asset_index, .mesh = target.mesh, .parts = std::move(parts)};
    if (auto done = work_out(world, target, mesh, cover); !done) return done.error();
    list.push_back(std::move(cover));
    return list.size() - 1;
}

Result<void> cover_mesh(World& world, Entity mesh, const std::vector<Entity>& all_hair) {
    MeshBelow below{.mesh = mesh};
    std::ranges::copy_if(all_hair, std::back_inserter(below.hair),
                         [&](Entity hair) { return moves_with(world, hair, mesh); });
    if (below.hair.empty()) return {};
    auto target = find_rest_target(world, mesh);
    if (!target) return target.error();
    std::vector<CoverPart> parts;
    for (const Entity hair : below.hair) parts.push_back(part_of(world, *target, hair));
    const uint32_t index = world.get<scene::MeshInstance>(mesh)->mesh;
    auto cover = find_cover(world, *target, index, std::move(parts));
    if (!cover) return cover.error();
    below.cover = *cover;
    auto& covers = world.resource<HairCovers>();
    const Cover& made = covers.covers[*cover];
    world.remove<character::SkyCover>(mesh);
    if (made.vertices) {
        world.add(mesh, character::SkyCover{.vertices = made.vertices.address(),
                                            .primitives = made.primitives,
                                            .thickness = 0.0f});
    }
    std::erase_if(covers.meshes, [&](const MeshBelow& other) { return other.mesh == mesh; });
    covers.meshes.push_back(std::move(below));
    return {};
}

/// Whether it is in view, and meshes do not know of it yet.
bool is_fresh(const Hair& hair, const HairTechniques& techniques, const HairMaterial& material,
              const scene::WorldBounds& bounds, const CoversMeshes* known,
              const scene::ViewState& view) {
    return (known == nullptr || known->groom != hair.groom) && covers(techniques, material) &&
           in_view(bounds.box, view);
}

void cover_all(World& world) {
    std::vector<Entity> hair;
    std::vector<CoversMeshes> grooms;
    const auto& view = world.resource<scene::ViewState>();
    world
        .query<Entity, const Hair, const HairTechniques, const HairMaterial,
               const scene::WorldBounds, const CoversMeshes*>()
        .each([&](Entity entity, const Hair& item, const HairTechniques& techniques,
                  const HairMaterial& material, const scene::WorldBounds& bounds,
                  const CoversMeshes* known) {
            if (!known && !is_fresh(item, techniques, material, bounds, known, view)) return;
            hair.push_back(entity);
            grooms.push_back({item.groom});
        });
    for (size_t i = 0; i < hair.size(); ++i) world.add(hair[i], grooms[i]);
    std::vector<Entity> meshes;
    world.query<Entity, With<scene::MeshInstance>>().each(
        [&](Entity entity) { meshes.push_back(entity); });
    for (const Entity mesh : meshes) {
        if (auto done = cover_mesh(world, mesh, hair); !done) {
            world.resource<scene::RenderFrame>().fail(done.error());
        }
    }
    for (LibraryGroom& groom : world.resource<HairLibrary>().grooms) groom.volume.reset();
}

glsl::HairAverages averages_of(const LibraryGroom& groom, const HairMaterial& material,
                               FibreLibrary& fibres) {
    const float shift = std::sin(material.shift);
    const auto fibre = fibres.fibre(fibre_optics(material), material.roughness, shift);
    const glsl::HairSurface surface{mean_color(groom, material), 0.5f * material.specular,
                                    material.roughness, material.scatter, shift};
    const float sine2 = 1.0f - kMeanCosine * kMeanCosine;
    const float cos2_t = 1.0f - sine2 * fibre.inverse_index2;
    return glsl::hair_averages(
        fibre, surface, glsl::hair_log2_color(surface.base_color) * (0.5f / std::sqrt(cos2_t)),
        kMeanCosine);
}

}  // namespace

void cover_meshes(WornHairQuery hair, Res<const scene::ViewState> view, Commands& commands) {
    bool any = false;
    hair.each([&](const Hair& item, const HairTechniques& techniques, const HairMaterial& material,
                  const scene::WorldBounds& bounds, const CoversMeshes* known) {
        any |= is_fresh(item, techniques, material, bounds, known, *view);
    });
    if (any) commands.defer([](World& world) { cover_all(world); });
}

void update_sky_covers(CoveringHairQuery hair, Query<character::SkyCover> covers_of,
                       Res<const HairCovers> known, Res<const HairLibrary> library,
                       Res<FibreLibrary> fibres) {
    for (const MeshBelow& below : known->meshes) {
        const auto found = covers_of.get(below.mesh);
        if (!found) continue;
        auto& sky = std::get<0>(*found);
        const Cover& cover = known->covers[below.cover];
        float all = 0.0f;
        float left = 0.0f;
        glm::vec3 forward(0.0f);
        glm::vec3 backward(0.0f);
        for (size_t i = 0; i < below.hair.size(); ++i) {
            all += cover.amounts[i];
            const auto worn = hair.get(below.hair[i]);
            if (!worn) continue;
            const auto& [item, techniques, material, width, transform] = *worn;
            if (!covers(techniques, material)) continue;
            const LibraryGroom& groom = library->grooms[item.groom];
            const float amount =
                cover.amounts[i] * drawn_thickness(groom, width, material.alpha, transform.matrix);
            const auto averages = averages_of(groom, material, *fibres);
            const float multiple = std::min(material.scatter, 1.0f);
            forward += amount * multiple * averages.forward;
            backward += amount * multiple * averages.backward;
            left += amount;
        }
        sky.thickness = all > 0.0f ? left / all : 0.0f;
        if (left <= 0.0f) continue;
        sky.forward = forward / left;
        sky.backward = backward / left;
    }
}

}  // namespace vellus::hair
