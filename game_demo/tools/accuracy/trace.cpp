#include "game_demo/tools/accuracy/trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/platform/jobs.h"
#include "game_demo/tools/reference/gather_scene.h"
#include "modules/hair/reference/tracer/fibre_frame.h"
#include "modules/hair/reference/tracer/film.h"
#include "modules/hair/reference/tracer/geometry.h"

namespace vellus::demo {

namespace {

namespace tracer = hair::tracer;

constexpr uint32_t kFirstSamples = 16;

/// Mean of |x| over the standard deviation of a normal x.
const double kMeanOfNormal = std::sqrt(2.0 / std::numbers::pi);

/// The noise of blocks' means: variances of pixels add up.
double noise_of(const tracer::Film& film, uint32_t block) {
    double noise = 0.0;
    for (const glm::dvec3& variance : block_sums(film.size(), block, [&](size_t i) {
             const glm::dvec3 error = film.hair(i) * film.standard_error(i);
             return error * error;
         })) {
        const glm::dvec3 deviation = glm::sqrt(variance);
        noise += kMeanOfNormal * (deviation.x + deviation.y + deviation.z);
    }
    return noise;
}

Reference reference_of(const tracer::Film& film) {
    Reference reference{.picture = {film.size(), {}}, .weight = {}, .block = kTracedBlock};
    double total = 0.0;
    for (size_t i = 0; i < film.pixel_count(); ++i) {
        const glm::dvec3 mean = film.mean(i);
        const double weight = film.hair(i);
        reference.picture.pixels.emplace_back(mean);
        reference.weight.push_back(static_cast<float>(weight));
        total += weight * (mean.x + mean.y + mean.z);
    }
    reference.noise = total > 0.0 ? noise_of(film, kTracedBlock) / total : 0.0;
    return reference;
}

/// From where a ray met a strand to the light, past that strand.
tracer::Ray light_ray(const tracer::Scene& scene, const tracer::Ray& ray, const tracer::Hit& hit,
                      uint64_t seed) {
    const tracer::Groom& groom = scene.grooms[hit.groom];
    const tracer::StrandPoint point = tracer::strand_point(groom, hit.primitive, hit.at.x);
    tracer::Ray out{.origin = ray.origin + hit.distance * ray.direction,
                    .direction = scene.lights[0].to_light,
                    .near = 1e-6,
                    .seed = seed};
    // A chord through a fibre is at most two radii over the cosine of its inclination long.
    const double sine = glm::dot(glm::normalize(point.tangent), out.direction);
    const double cosine = std::max(std::sqrt(std::max(1.0 - sine * sine, 0.0)), 0.1);
    out.own = {hit.groom, groom.segment_strand[hit.primitive], 2.5 * point.radius / cosine};
    return out;
}

}  // namespace

Result<tracer::Scene> trace_scene(const StudioGroom& groom, const StudioLook& look, uint32_t size) {
    auto host = CpuHost::create();
    if (!host) return host.error();
    const auto add = [&](const StudioGroom& grown) -> Result<uint32_t> {
        return (*host)->add_strands(grown.name, grown.strands, grown.report);
    };
    auto hair = set_up_studio(**host, add, groom, look, size);
    if (!hair) return hair.error();
    (*host)->run_to_frame(0);
    return gather_scene(**host);
}

Result<Reference> path_traced(tracer::Scene scene, uint32_t size, uint32_t samples, uint64_t seed,
                              const std::atomic<bool>& stop) {
    auto path_tracer = tracer::PathTracer::create(std::move(scene), {});
    if (!path_tracer) return path_tracer.error();
    tracer::Film film(glm::uvec2{size});
    parallel_ranges(film.pixel_count(), 64, [&](size_t first, size_t last) {
        for (size_t pixel = first; pixel < last && !stop; ++pixel) {
            const glm::uvec2 at(pixel % size, pixel / size);
            for (uint32_t i = 0; i < samples; ++i) {
                // Where there is no hair nothing is compared.
                if (i == kFirstSamples && film.hair(pixel) == 0.0) break;
                const tracer::Random random(seed, static_cast<uint32_t>(pixel), i);
                auto sample = (*path_tracer)->sample(at, glm::uvec2(size), random);
                if (!sample.covered) sample.radiance = glm::dvec3(0.0);
                film.add(pixel, sample);
            }
        }
    });
    if (stop) return Error{"stopped", "", ""};
    return reference_of(film);
}

Result<VisibleHair> trace_visible(const tracer::Scene& scene, uint32_t size, uint32_t rays,
                                  uint64_t seed) {
    auto geometry = tracer::Geometry::build(scene);
    if (!geometry) return geometry.error();
    const size_t pixels = size_t{size} * size;
    VisibleHair visible{std::vector<float>(pixels, 0.0f), std::vector<float>(pixels, 1.0f)};
    parallel_ranges(pixels, 64, [&](size_t first, size_t last) {
        for (size_t pixel = first; pixel < last; ++pixel) {
            const glm::uvec2 at(pixel % size, pixel / size);
            uint32_t hair = 0;
            uint32_t lit = 0;
            for (uint32_t i = 0; i < rays; ++i) {
                tracer::Random random(seed, static_cast<uint32_t>(pixel), i);
                const tracer::Ray ray =
                    tracer::camera_ray(scene.camera, at, glm::uvec2(size), random);
                tracer::Hit hit;
                if (!(*geometry)->closest(ray, hit) || hit.groom == tracer::kNone) continue;
                ++hair;
                if (scene.lights.empty()) continue;
                const tracer::Ray out = light_ray(scene, ray, hit, random.bits());
                lit += (*geometry)->blocked(out, 1e9) ? 0 : 1;
            }
            visible.share[pixel] = static_cast<float>(hair) / static_cast<float>(rays);
            if (hair > 0) {
                visible.transmittance[pixel] = static_cast<float>(lit) / static_cast<float>(hair);
            }
        }
    });
    return visible;
}

}  // namespace vellus::demo
