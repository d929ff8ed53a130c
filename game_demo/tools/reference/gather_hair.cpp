#include "game_demo/tools/reference/gather_hair.h"

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "modules/hair/binding/hair_pose.h"
#include "modules/hair/components.h"
#include "modules/hair/dynamics/bend_strands.h"
#include "modules/hair/geometry/groom_colors.h"
#include "modules/scene/components.h"
#include "shaders/common/portable.h"

namespace vellus::demo {

namespace {

using hair::StrandData;

/// Diameters by point, before the taper: as HairDraw of geometry/hair_frame.cpp has them.
std::vector<float> diameters(const StrandData& strands, const hair::HairWidth& width,
                             const glm::dmat4& world) {
    const size_t count = strands.positions.size();
    // A width that is given is in metres of the world, however the node scales its groom.
    if (width.root > 0.0f) return std::vector<float>(count, width.root);
    const auto scale = static_cast<float>(std::cbrt(std::abs(glm::determinant(glm::dmat3(world)))));
    std::vector<float> result = strands.point_width;
    if (result.empty()) result.assign(count, strands.width);
    for (float& diameter : result) diameter *= scale;
    return result;
}

std::vector<glm::dvec3> rigid_points(const StrandData& strands, const glm::dmat4& world) {
    std::vector<glm::dvec3> points;
    points.reserve(strands.positions.size());
    for (const glm::vec3& p : strands.positions) {
        points.emplace_back(world * glm::dvec4(p, 1.0));
    }
    return points;
}

/// Points of a groom that a mesh carries, as hair/binding/deform.comp.glsl places them.
std::vector<glm::dvec3> bound_points(const hair::BoundRoots& bound, const hair::HairPose& pose) {
    std::vector<glm::dvec3> points(bound.local.size());
    for (uint32_t strand = 0; strand < bound.roots.size(); ++strand) {
        const hair::RootFrame frame = hair::root_frame(bound, pose, strand, hair::PoseOf::kNow);
        const hair::BoundRoot& root = bound.roots[strand];
        for (uint32_t i = root.first_point; i < root.first_point + root.point_count; ++i) {
            points[i] = frame.position + frame.axes * glm::dvec3(bound.local[i]);
        }
    }
    return points;
}

/// Smooth tangents at the points: along the neighbours, at the ends along the segment.
std::vector<glm::vec3> tangents(const StrandData& strands, const std::vector<glm::dvec3>& points) {
    std::vector<glm::vec3> result(points.size());
    for (size_t strand = 0; strand < strands.strand_count(); ++strand) {
        const uint32_t first = strands.strand_begin[strand];
        const uint32_t last = strands.strand_begin[strand + 1] - 1;
        for (uint32_t i = first; i <= last && first < last; ++i) {
            const glm::dvec3 along =
                points[std::min(i + 1, last)] - points[std::max(i, first + 1) - 1];
            const double length = glm::length(along);
            result[i] = length > 0.0 ? glm::vec3(along / length) : glm::vec3(0.0f);
        }
    }
    return result;
}

/// The groom's own colours and each strand's brightness, as hair_color() of
/// geometry/instance.glsl.
std::vector<glm::vec3> tints(const StrandData& strands, const hair::HairMaterial& material) {
    std::vector<glm::vec3> result(strands.segment_count());
    const bool colors = material.use_groom_colors && !strands.point_color.empty();
    for (size_t i = 0; i < result.size(); ++i) {
        glm::vec3 color(1.0f);
        if (colors) {
            const glm::uvec2 halves = strands.point_color[strands.segment_point[i]];
            color = glm::vec3(glm::unpackHalf2x16(halves.x), glm::unpackHalf2x16(halves.y).x);
        }
        const uint32_t seed = strands.strand_seed[strands.segment_strand[i]];
        const float random = glsl::unit_float(glsl::hash_uint(seed ^ 0x5bd1e995u));
        result[i] = color * (1.0f + material.color_variation * (2.0f * random - 1.0f));
    }
    return result;
}

hair::tracer::Groom make_groom(const StrandData& strands, const hair::LibraryGroom& library,
                               const std::vector<glm::dvec3>& points,
                               const std::vector<float>& diameter, float tip_scale,
                               const hair::HairMaterial& material, const glm::dvec3& camera) {
    hair::tracer::Groom groom;
    groom.points.resize(points.size());
    groom.parameter.resize(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        groom.parameter[i] = static_cast<float>(strands.point_parameter[i]) / 65535.0f;
        const float taper = glm::mix(1.0f, tip_scale, groom.parameter[i]);
        groom.points[i] = glm::vec4(points[i] - camera, 0.5f * diameter[i] * taper);
    }
    groom.tangents = tangents(strands, points);
    groom.segment_point = strands.segment_point;
    groom.segment_strand = strands.segment_strand;
    groom.segment_tint = tints(strands, material);
    const hair::RootTipColors colors = hair::root_tip_colors(library, material);
    groom.base_color = colors.root;
    groom.tip_color = colors.tip;
    groom.gradient_start = material.gradient_start;
    groom.roughness = material.roughness;
    groom.tilt = material.shift;
    groom.specular = material.specular;
    groom.eta = material.eta;
    groom.azimuthal = material.azimuthal;
    groom.alpha = material.alpha;
    return groom;
}

hair::tracer::GroomLight light_of(const hair::HairTechniques& techniques) {
    return {.hair_shadow = techniques.shadow != hair::ShadowTechnique::kNone,
            .multiple = techniques.multiple != hair::MultipleTechnique::kNone,
            .environment = techniques.environment != hair::EnvironmentTechnique::kNone};
}

}  // namespace

void gather_hair(CpuHost& host, const glm::dvec3& camera,
                 std::vector<hair::tracer::Groom>& grooms) {
    World& world = host.world();
    const auto& library = world.resource<hair::HairLibrary>().grooms;
    const auto& bindings = world.resource<hair::HairBindings>().list;
    const auto& poses = world.resource<hair::HairPoses>().list;
    const auto& motions = world.resource<hair::HairMotions>().list;
    world
        .query<const hair::Hair, const scene::WorldTransform, const hair::HairMaterial,
               const hair::HairWidth, const hair::HairTechniques, const hair::HairBinding*,
               const hair::HairMotion*, const hair::HairMoves*>()
        .each([&](const hair::Hair& item, const scene::WorldTransform& placed,
                  const hair::HairMaterial& material, const hair::HairWidth& width,
                  const hair::HairTechniques& techniques, const hair::HairBinding* binding,
                  const hair::HairMotion* motion, const hair::HairMoves* moves) {
            const StrandData& strands = host.strands(item.groom);
            if (strands.segment_count() == 0 || material.alpha <= 0.0f) return;
            const bool bound = binding != nullptr && binding->pose != hair::kNoPose;
            auto points = bound ? bound_points(bindings[binding->roots].roots, poses[binding->pose])
                                : rigid_points(strands, placed.matrix);
            if (motion != nullptr && moves != nullptr && moves->now) {
                hair::bend_strands(*motions[motion->slot], strands.strand_begin,
                                   strands.point_parameter, points);
            }
            grooms.push_back(make_groom(strands, library[item.groom], points,
                                        diameters(strands, width, placed.matrix), width.tip_scale,
                                        material, camera));
            grooms.back().light = light_of(techniques);
        });
}

}  // namespace vellus::demo
