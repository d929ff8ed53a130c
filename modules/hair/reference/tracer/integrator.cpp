#include "modules/hair/reference/tracer/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "modules/hair/reference/tracer/fibre_frame.h"
#include "modules/hair/reference/tracer/mesh_scattering.h"

namespace vellus::hair::tracer {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kMostLikely = 0.98;  // of going on, so that a lossless path ends too
constexpr double kOwnWidths = 2.5;    // chords through a strand are at most two radii / cos θ long
constexpr double kLeastCosine = 0.1;

/// How far a ray must be from where it starts before it can hit: above the rounding of floats.
double offset_at(const glm::dvec3& position) {
    const double reach =
        std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    return 1e-6 + 4e-7 * reach;
}

double largest(const glm::dvec3& c) {
    return std::max({c.x, c.y, c.z});
}

reference::ChiangFibre fibre_of(const Groom& groom, const glm::dvec3& color) {
    auto fibre = reference::chiang_from_karis(color, groom.roughness, groom.tilt);
    fibre.eta = groom.eta;
    fibre.azimuthal_scale[1] *= groom.azimuthal;
    fibre.azimuthal_scale[2] *= groom.azimuthal;
    fibre.specular = groom.specular;
    return fibre;
}

}  // namespace

/// Where a path scatters: on a fibre or on a mesh.
struct PathTracer::Vertex {
    glm::dvec3 position{0.0};
    glm::dvec3 to_eye{0.0};
    glm::dvec3 emitted{0.0};
    // Fibre.
    const Groom* groom = nullptr;
    OwnStrand own;
    double radius = 0.0;
    FibreFrame frame;
    std::optional<reference::ChiangScattering> fibre;
    // Mesh.
    glm::dvec3 geometric_normal{0.0};
    std::optional<MeshScattering> surface;

    /// Scattering function times what its measure takes: radiance to the eye per irradiance across
    /// the beam.
    [[nodiscard]] glm::dvec3 evaluate(const glm::dvec3& to_light) const {
        if (fibre) return fibre->evaluate(frame.inclination(to_light), frame.azimuth(to_light));
        if (!surface || glm::dot(geometric_normal, to_light) <= 0.0) return glm::dvec3(0.0);
        return surface->evaluate(to_light);
    }
    [[nodiscard]] double pdf(const glm::dvec3& to_light) const {
        if (fibre) return fibre->pdf(frame.inclination(to_light), frame.azimuth(to_light));
        return surface ? surface->pdf(to_light) : 0.0;
    }
    /// The pdf is 0 where nothing scatters that way.
    MeshScattering::Sample sample(Random& random) const {
        if (fibre) {
            const auto s = fibre->sample(random.unit4());
            return {frame.direction(s.i, s.phi), s.pdf, s.weight};
        }
        if (!surface) return {};
        const glm::dvec4 u = random.unit4();
        MeshScattering::Sample s = surface->sample({u.x, u.y, u.z});
        if (glm::dot(geometric_normal, s.direction) <= 0.0) s.weight = glm::dvec3(0.0);
        return s;
    }
    /// A ray that leaves, past its own strand.
    [[nodiscard]] Ray leave(const glm::dvec3& direction, uint64_t seed) const {
        Ray ray{.origin = position, .direction = direction, .seed = seed};
        ray.near = offset_at(position);
        ray.own = own;
        if (fibre) {
            const double cosine = std::max(frame.inclination(direction).cos, kLeastCosine);
            ray.own.until = kOwnWidths * radius / cosine;
        }
        return ray;
    }
};

PathTracer::PathTracer(Scene scene, const TraceSettings& settings)
    : scene_(std::move(scene)), settings_(settings) {
    if (scene_.environment) environment_ = EnvironmentLight(*scene_.environment);
}

Result<std::unique_ptr<PathTracer>> PathTracer::create(Scene scene, const TraceSettings& settings) {
    std::unique_ptr<PathTracer> tracer(new PathTracer(std::move(scene), settings));
    auto geometry = Geometry::build(tracer->scene_);
    if (!geometry) return geometry.error();
    tracer->geometry_ = std::move(*geometry);
    return tracer;
}

PathTracer::Vertex PathTracer::vertex_at(const Ray& ray, const Hit& hit) const {
    Vertex v;
    v.position = ray.origin + hit.distance * ray.direction;
    v.to_eye = -ray.direction;
    if (hit.groom != kNone) {
        const Groom& groom = scene_.grooms[hit.groom];
        const StrandPoint point = strand_point(groom, hit.primitive, hit.at.x);
        v.groom = &groom;
        v.own = {hit.groom, groom.segment_strand[hit.primitive], 0.0};
        v.radius = point.radius;
        v.frame = fibre_frame(point.tangent, hit.normal, v.to_eye);
        v.fibre.emplace(fibre_of(groom, point.color), v.frame.h, v.frame.eye);
        return v;
    }
    const Mesh& mesh = scene_.meshes[hit.mesh];
    const glm::uvec3 corner = mesh.triangles[hit.primitive];
    const bool behind = glm::dot(hit.normal, v.to_eye) < 0.0;
    const bool back = behind != mesh.mirrored;
    // The back of a one-sided mesh is nothing the real-time path draws: it only blocks.
    if (back && !mesh.two_sided) return v;
    const glm::dvec3 w(1.0 - hit.at.x - hit.at.y, hit.at.x, hit.at.y);
    glm::dvec3 normal = hit.normal;
    if (!mesh.normals.empty()) {
        normal = glm::normalize(glm::dvec3(mesh.normals[corner.x]) * w.x +
                                glm::dvec3(mesh.normals[corner.y]) * w.y +
                                glm::dvec3(mesh.normals[corner.z]) * w.z);
        if (back) normal = -normal;
    } else if (behind) {
        normal = -normal;
    }
    v.geometric_normal = behind ? -hit.normal : hit.normal;
    v.emitted = mesh.emissive;
    const glm::vec4 color = mesh_color(scene_, mesh, hit.primitive, hit.at);
    v.surface.emplace(glsl::PbrSurface{glm::vec3(color), mesh.metallic, mesh.roughness}, normal,
                      v.to_eye);
    return v;
}

glm::dvec3 PathTracer::punctual_light(const Vertex& vertex, uint64_t seed) const {
    glm::dvec3 sum(0.0);
    for (const Light& light : scene_.lights) {
        glm::dvec3 to_light = light.to_light;
        glm::dvec3 irradiance = light.color;
        double distance = kFar;
        if (!light.sun) {
            // As light_irradiance() of light/lights.glsl.
            const glm::dvec3 d = light.position - vertex.position;
            const double squared = std::max(glm::dot(d, d), 1e-4);
            distance = std::sqrt(squared);
            to_light = d / distance;
            const double cone = std::clamp(
                glm::dot(to_light, light.to_light) * light.cone_scale + light.cone_offset, 0.0,
                1.0);
            irradiance *= cone * cone / squared;
        }
        if (largest(irradiance) <= 0.0) continue;
        const glm::dvec3 scattered = vertex.evaluate(to_light) * irradiance;
        if (largest(scattered) <= 0.0) continue;
        Ray ray = vertex.leave(to_light, seed);
        ray.ignores_hair = vertex.groom != nullptr && !vertex.groom->light.hair_shadow;
        if (!geometry_->blocked(ray, distance)) sum += scattered;
    }
    return sum;
}

double PathTracer::environment_pdf(const glm::dvec3& direction) const {
    return settings_.uniform_environment ? 0.25 / kPi : environment_.pdf(direction);
}

glm::dvec3 PathTracer::environment_light(const Vertex& vertex, Random& random) const {
    const glm::dvec2 u = random.unit2();
    const uint64_t seed = random.bits();
    EnvironmentLight::Sample light;
    if (settings_.uniform_environment) {
        const double y = 1.0 - 2.0 * u.x;
        const double across = std::sqrt(std::max(1.0 - y * y, 0.0));
        const double turn = 2.0 * kPi * u.y;
        light = {{across * std::sin(turn), y, across * std::cos(turn)}, 0.25 / kPi};
    } else {
        light = environment_.sample(u);
    }
    if (light.pdf <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 scattered = vertex.evaluate(light.direction);
    if (largest(scattered) <= 0.0) return glm::dvec3(0.0);
    if (geometry_->blocked(vertex.leave(light.direction, seed), kFar)) return glm::dvec3(0.0);
    const double other = settings_.mis ? vertex.pdf(light.direction) : 0.0;
    return scattered * environment_.radiance(light.direction) / (light.pdf + other);
}

PathSample PathTracer::trace(Ray ray, Random& random) const {
    PathSample result;
    glm::dvec3 throughput(1.0);
    double scatter_pdf = 0.0;      // of the ray's direction; 0: the camera chose it
    bool sees_environment = true;  // the vertex it left takes environment light
    bool sees_scattered = true;    // and light that other things scattered
    for (uint32_t depth = 0;; ++depth) {
        Hit hit;
        if (!geometry_->closest(ray, hit)) {
            if (!sees_environment || environment_.black()) break;
            double weight = 1.0;
            if (depth > 0) {
                weight = settings_.mis
                             ? scatter_pdf / (scatter_pdf + environment_pdf(ray.direction))
                             : 0.0;
            }
            if (weight > 0.0) {
                result.radiance += throughput * environment_.radiance(ray.direction) * weight;
            }
            break;
        }
        if (depth == 0) {
            result.covered = true;
            result.hair = hit.groom != kNone;
        }
        if (!sees_scattered) break;
        const Vertex vertex = vertex_at(ray, hit);
        result.radiance += throughput * vertex.emitted;
        if (!vertex.fibre && !vertex.surface) break;
        if (settings_.max_depth != 0 && depth >= settings_.max_depth) break;

        result.radiance += throughput * punctual_light(vertex, random.bits());
        sees_environment = vertex.groom == nullptr || vertex.groom->light.environment;
        sees_scattered = vertex.groom == nullptr || vertex.groom->light.multiple;
        if (sees_environment && !environment_.black()) {
            result.radiance += throughput * environment_light(vertex, random);
        }
        const MeshScattering::Sample next = vertex.sample(random);
        throughput *= next.weight;
        scatter_pdf = next.pdf;
        if (next.pdf <= 0.0 || largest(throughput) <= 0.0) break;
        if (depth >= settings_.roulette_from) {
            const double go_on = std::min(largest(throughput), kMostLikely);
            if (random.unit() >= go_on) break;
            throughput /= go_on;
        }
        ray = vertex.leave(next.direction, random.bits());
    }
    return result;
}

Ray camera_ray(const Camera& camera, const glm::uvec2& at, const glm::uvec2& size, Random& random) {
    const glm::dvec2 ndc = 2.0 * (glm::dvec2(at) + random.unit2()) / glm::dvec2(size) - 1.0;
    const glm::dvec3 direction = camera.axes * glm::dvec3(ndc.x * camera.tan_half_fov.x,
                                                          -ndc.y * camera.tan_half_fov.y, -1.0);
    const double length = glm::length(direction);
    return {.direction = direction / length,
            .near = camera.near_plane * length,
            .seed = random.bits(),
            .from_camera = true};
}

PathSample PathTracer::sample(const glm::uvec2& at, const glm::uvec2& size, Random random) const {
    const Ray ray = camera_ray(scene_.camera, at, size, random);
    return trace(ray, random);
}

}  // namespace vellus::hair::tracer
