#pragma once

#include <cmath>

#include "modules/hair/reference/tracer/integrator.h"
#include "tests/support/sampling.h"

namespace vellus::hair::tracer::test {

/// Strands given by their points, all of one radius.
inline Groom make_groom(const std::vector<std::vector<glm::vec3>>& strands, float radius) {
    Groom groom;
    for (uint32_t strand = 0; strand < strands.size(); ++strand) {
        const auto& points = strands[strand];
        for (size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 along =
                points[std::min(i + 1, points.size() - 1)] - points[std::max<size_t>(i, 1) - 1];
            groom.tangents.push_back(glm::normalize(along));
            groom.parameter.push_back(static_cast<float>(i) /
                                      static_cast<float>(points.size() - 1));
            if (i + 1 < points.size()) {
                groom.segment_point.push_back(static_cast<uint32_t>(groom.points.size()));
                groom.segment_strand.push_back(strand);
                groom.segment_tint.emplace_back(1.0f);
            }
            groom.points.emplace_back(points[i], radius);
        }
    }
    groom.base_color = groom.tip_color = glm::vec3(0.5f, 0.3f, 0.15f);
    return groom;
}

/// A loose ball of short, gently bent strands around `center`.
inline Groom make_ball(const glm::vec3& center, float size, int count, float radius) {
    std::vector<std::vector<glm::vec3>> strands;
    for (int i = 0; i < count; ++i) {
        vellus::test::Random random(21, i);
        const glm::vec3 middle = center + glm::vec3(random.direction()) * size *
                                              static_cast<float>(std::cbrt(random.unit()));
        const glm::vec3 along = glm::vec3(random.direction()) * size * 0.5f;
        const glm::vec3 bend = glm::vec3(random.direction()) * size * 0.1f;
        strands.push_back({middle - along, middle + bend, middle + along});
    }
    return make_groom(strands, radius);
}

inline Environment constant_environment(const glm::vec3& radiance) {
    Environment environment;
    environment.pixels.width = 8;
    environment.pixels.height = 4;
    for (int i = 0; i < 32; ++i) {
        for (const float c : {radiance.x, radiance.y, radiance.z, 1.0f}) {
            environment.pixels.rgba.push_back(c);
        }
    }
    return environment;
}

/// A dim sky with a bright spot and a gradient.
inline Environment uneven_environment() {
    Environment environment;
    environment.rotation = 0.4;
    environment.pixels.width = 32;
    environment.pixels.height = 16;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool bright = x == 20 && y == 5;
            const float sky = 0.1f + 0.02f * static_cast<float>(16 - y);
            for (const float c : {bright ? 400.0f : sky, bright ? 350.0f : sky,
                                  bright ? 300.0f : 1.5f * sky, 1.0f}) {
                environment.pixels.rgba.push_back(c);
            }
        }
    }
    return environment;
}

inline std::unique_ptr<PathTracer> make_tracer(Scene scene, const TraceSettings& settings = {}) {
    auto made = PathTracer::create(std::move(scene), settings);
    EXPECT_TRUE(made);
    return std::move(*made);
}

/// Mean of many independent estimates with its standard error.
struct Estimate {
    glm::dvec3 mean{0.0};
    glm::dvec3 error{0.0};
    glm::dvec3 variance{0.0};  ///< of one sample
};

template <class Sample>
Estimate estimate(int count, const Sample& sample) {
    glm::dvec3 sum(0.0);
    glm::dvec3 squares(0.0);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 value = sample(i);
        sum += value;
        squares += value * value;
    }
    Estimate result;
    result.mean = sum / static_cast<double>(count);
    result.variance =
        glm::max(squares / static_cast<double>(count) - result.mean * result.mean, 0.0);
    result.error = glm::sqrt(result.variance / static_cast<double>(count));
    return result;
}

/// Rays towards points of a disc around `target`, all over it.
inline Estimate look_at(const PathTracer& tracer, const glm::dvec3& target, double radius,
                        int count, uint64_t seed = 0) {
    return estimate(count, [&](int i) {
        Random random(seed, 7, static_cast<uint32_t>(i));
        const glm::dvec2 u = random.unit2();
        const double r = radius * std::sqrt(u.x);
        const double turn = 6.283185307179586 * u.y;
        const glm::dvec3 to = target + glm::dvec3(r * std::cos(turn), r * std::sin(turn), 0.0);
        const Ray ray{.direction = glm::normalize(to), .seed = random.bits(), .from_camera = true};
        return tracer.trace(ray, random).radiance;
    });
}

}  // namespace vellus::hair::tracer::test
