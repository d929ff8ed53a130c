#include <gtest/gtest.h>

#include <numbers>

#include "modules/hair/reference/tracer/fibre_frame.h"
#include "modules/hair/reference/tracer/mesh_scattering.h"
#include "tests/unit/tracer/scenes.h"

namespace vellus::hair::tracer {
namespace {

constexpr glm::dvec3 kBall(0.0, 0.0, -1.0);

Scene ball_scene(const glm::vec3& color) {
    Scene scene;
    scene.grooms.push_back(test::make_ball(glm::vec3(kBall), 0.1f, 400, 0.003f));
    scene.grooms[0].base_color = scene.grooms[0].tip_color = color;
    return scene;
}

TEST(PathTracer, WhiteHairVanishesInAWhiteSphere) {
    Scene scene = ball_scene(glm::vec3(1.0f));
    scene.environment = test::constant_environment(glm::vec3(1.0f));
    const auto tracer = test::make_tracer(std::move(scene));
    const auto seen = test::look_at(*tracer, kBall, 0.08, 6000);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(seen.mean[c], 1.0, 4.5 * seen.error[c] + 1e-6);
        EXPECT_LT(seen.error[c], 0.02);
    }
}

TEST(PathTracer, ColouredHairTakesNoMoreThanArrives) {
    Scene scene = ball_scene(glm::vec3(0.9f, 0.5f, 0.05f));
    scene.environment = test::constant_environment(glm::vec3(2.0f));
    const auto tracer = test::make_tracer(std::move(scene));
    const auto seen = test::look_at(*tracer, kBall, 0.08, 3000);
    EXPECT_LT(seen.mean.x, 2.0);
    EXPECT_LT(seen.mean.y, seen.mean.x);
    EXPECT_LT(seen.mean.z, seen.mean.y);
    EXPECT_GT(seen.mean.z, 0.05);
}

/// One cylinder along x at 1 m, seen across; rays meet it at a chosen offset.
Scene cylinder_scene(float radius) {
    Scene scene;
    scene.grooms.push_back(test::make_groom({{{-1, 0, -1}, {0, 0, -1}, {1, 0, -1}}}, radius));
    scene.lights.push_back({.to_light = glm::normalize(glm::dvec3(0.3, 0.5, 0.8)),
                            .color = glm::dvec3(2.0, 1.0, 0.5)});
    return scene;
}

TEST(PathTracer, OneCylinderIsTheScatteringFunctionAtItsOffset) {
    const Scene scene = cylinder_scene(0.05f);
    const auto tracer = test::make_tracer(scene, {.max_depth = 1});
    const auto fibre = reference::chiang_from_karis(glm::dvec3(glm::vec3(0.5f, 0.3f, 0.15f)),
                                                    scene.grooms[0].roughness, 0.0);
    const glm::dvec3 to_light = scene.lights[0].to_light;
    const glm::dvec3 to_eye(0.0, 0.0, 1.0);
    for (const double h : {-0.95, -0.4, 0.0, 0.3, 0.8}) {
        Random random(1, 2, 3);
        // The tangent is +x and the eye +z, so the quarter turn on is x × z = -y: a point at height
        // y has its normal there, and h = -n·aside = n.y.
        const Ray ray{.origin = {0.25, 0.05 * h, 0.0}, .direction = -to_eye};
        const PathSample sample = tracer->trace(ray, random);
        ASSERT_TRUE(sample.hair);
        const reference::ChiangScattering scattering(fibre, h, {0.0, 1.0});
        const reference::Inclination i{to_light.x, std::sqrt(1.0 - to_light.x * to_light.x)};
        const double phi = std::atan2(-to_light.y, to_light.z);
        const glm::dvec3 exact = scattering.evaluate(i, phi) * scene.lights[0].color;
        // Embree's floats place the hit to some 1e-6 of the radius; near |h| = 1 γ follows steeply.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.radiance[c] / exact[c], 1.0, 2e-3) << h;
    }
}

TEST(PathTracer, ACylindersWidthIsTheIntegralOverItsOffsets) {
    const float radius = 0.02f;
    Scene scene = cylinder_scene(radius);
    scene.grooms[0].roughness = 0.4f;
    const auto fibre =
        reference::chiang_from_karis(glm::dvec3(glm::vec3(0.5f, 0.3f, 0.15f)), 0.4f, 0.0);
    const glm::dvec3 to_light = scene.lights[0].to_light;
    glm::dvec3 exact(0.0);
    constexpr int kSteps = 4000;
    for (int k = 0; k < kSteps; ++k) {
        const reference::ChiangScattering s(fibre, 2.0 * (k + 0.5) / kSteps - 1.0, {0.0, 1.0});
        exact += s.evaluate({to_light.x, std::sqrt(1.0 - to_light.x * to_light.x)},
                            std::atan2(-to_light.y, to_light.z));
    }
    exact *= scene.lights[0].color / static_cast<double>(kSteps);
    const auto tracer = test::make_tracer(std::move(scene));
    const auto seen = test::estimate(20'000, [&](int i) {
        Random random(4, 0, static_cast<uint32_t>(i));
        const double offset = radius * (2.0 * random.unit() - 1.0);
        return tracer->trace({.origin = {0.1, offset, 0.0}}, random).radiance;
    });
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen.mean[c], exact[c], 4.5 * seen.error[c]);
}

TEST(PathTracer, VarianceFallsAsOneOverTheSamples) {
    Scene scene = ball_scene(glm::vec3(0.7f, 0.5f, 0.3f));
    scene.environment = test::constant_environment(glm::vec3(1.0f));
    const auto tracer = test::make_tracer(std::move(scene), {.max_depth = 4});
    constexpr int kGroups = 4000;
    const auto spread = [&](int samples) {
        return test::estimate(
                   kGroups,
                   [&](int group) {
                       return test::look_at(*tracer, kBall, 0.05, samples, 100 + group).mean;
                   })
            .variance.y;
    };
    // A variance of 4000 means of kurtosis below 6 is known to √(5/4000) = 3.5 %, the ratio to 5 %.
    EXPECT_NEAR(spread(2) / spread(8), 4.0, 4.0 * 4.5 * 0.05);
}

TEST(PathTracer, ImportanceUniformAndMisHaveTheSameMean) {
    const auto look = [](const TraceSettings& settings, int count) {
        Scene scene = ball_scene(glm::vec3(0.7f, 0.5f, 0.3f));
        scene.environment = test::uneven_environment();
        return test::look_at(*test::make_tracer(std::move(scene), settings), kBall, 0.08, count);
    };
    const auto best = look({.max_depth = 3}, 8000);
    const auto no_mis = look({.max_depth = 3, .mis = false}, 8000);
    const auto uniform = look({.max_depth = 3, .uniform_environment = true}, 30'000);
    const auto agree = [](const test::Estimate& a, const test::Estimate& b) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(a.mean[c], b.mean[c], 4.5 * std::hypot(a.error[c], b.error[c]));
        }
    };
    agree(best, no_mis);
    agree(best, uniform);
    // And importance sampling is worth having.
    EXPECT_LT(best.variance.y, 0.5 * uniform.variance.y);
}

TEST(PathTracer, RouletteDoesNotChangeTheMean) {
    // Without it paths end after 80 events, which loses less than .95^80 = 2 % of a small rest.
    Scene scene = ball_scene(glm::vec3(0.9f, 0.6f, 0.3f));
    scene.environment = test::constant_environment(glm::vec3(1.0f));
    const auto endless = test::look_at(*test::make_tracer(scene), kBall, 0.08, 8000);
    const auto early =
        test::look_at(*test::make_tracer(scene, {.roulette_from = 1}), kBall, 0.08, 8000, 8);
    const TraceSettings none{.max_depth = 80, .roulette_from = 1000};
    const auto limited = test::look_at(*test::make_tracer(scene, none), kBall, 0.08, 8000, 9);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(endless.mean[c], limited.mean[c],
                    4.5 * std::hypot(endless.error[c], limited.error[c]));
        EXPECT_NEAR(early.mean[c], limited.mean[c],
                    4.5 * std::hypot(early.error[c], limited.error[c]));
    }
}

TEST(PathTracer, TechniquesSwitchLightOff) {
    Scene scene = ball_scene(glm::vec3(0.8f));
    scene.environment = test::constant_environment(glm::vec3(1.0f));
    scene.lights.push_back({.to_light = {0.0, 0.6, 0.8}, .color = glm::dvec3(3.0)});
    const auto all = test::look_at(*test::make_tracer(scene), kBall, 0.05, 3000).mean.x;
    const auto with = [&](GroomLight light) {
        Scene changed = scene;
        changed.grooms[0].light = light;
        return test::look_at(*test::make_tracer(std::move(changed)), kBall, 0.05, 3000).mean.x;
    };
    EXPECT_LT(with({.multiple = false}), 0.9 * all);
    EXPECT_LT(with({.environment = false}), 0.9 * all);
    EXPECT_GT(with({.hair_shadow = false}), 1.1 * all);
}

Mesh floor_mesh() {
    Mesh mesh;
    mesh.positions = {{-5, -1, -5}, {5, -1, -5}, {5, -1, 5}, {-5, -1, 5}};
    mesh.normals.assign(4, glm::vec3(0, 1, 0));
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    mesh.base_color = {0.6f, 0.4f, 0.2f, 1.0f};
    mesh.roughness = 0.7f;
    return mesh;
}

TEST(PathTracer, AFloorInTheSunIsItsShadersValue) {
    Scene scene;
    scene.meshes.push_back(floor_mesh());
    scene.lights.push_back(
        {.to_light = glm::normalize(glm::dvec3(0.5, 1.0, 0.2)), .color = glm::dvec3(2.0)});
    const auto tracer = test::make_tracer(scene, {.max_depth = 1});
    Random random(1, 1, 1);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.1, -1.0, -0.7));
    const PathSample sample = tracer->trace({.direction = direction, .from_camera = true}, random);
    EXPECT_TRUE(sample.covered);
    EXPECT_FALSE(sample.hair);
    const glm::vec3 exact =
        glsl::pbr_direct({glm::vec3(0.6f, 0.4f, 0.2f), 0.0f, 0.7f}, {0, 1, 0},
                         glm::vec3(scene.lights[0].to_light), glm::vec3(-direction)) *
        2.0f;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.radiance[c], exact[c], 1e-6);
    // From below the camera does not see it, but it still stands in the sun's way.
    Random other(1, 1, 2);
    EXPECT_FALSE(
        tracer->trace({.origin = {0, -2, 0}, .direction = {0, 1, 0}, .from_camera = true}, other)
            .covered);
}

TEST(PathTracer, SpotsFallOffAsInTheShader) {
    Scene scene;
    scene.meshes.push_back(floor_mesh());
    const glm::dvec3 at(0.0, 1.0, 0.0);
    scene.lights.push_back({.sun = false,
                            .position = at,
                            .to_light = {0.0, 1.0, 0.0},
                            .color = glm::dvec3(4.0),
                            .cone_scale = 5.0,
                            .cone_offset = -4.0});
    const auto tracer = test::make_tracer(scene, {.max_depth = 1});
    const auto seen = [&](double x) {
        Random random(1, 1, 1);
        const glm::dvec3 to(x, -1.0, -0.01);
        return tracer->trace({.direction = glm::normalize(to)}, random).radiance.x;
    };
    EXPECT_GT(seen(0.0), 0.0);
    EXPECT_LT(seen(0.8), seen(0.4));
    EXPECT_EQ(seen(2.0), 0.0);  // cos = .7: outside the cone
}

TEST(PathTracer, TranslucentStrandsCoverTheirShare) {
    Scene scene = cylinder_scene(0.05f);
    scene.grooms[0].alpha = 0.3f;
    const auto tracer = test::make_tracer(std::move(scene), {.max_depth = 1});
    int covered = 0;
    constexpr int kRays = 4000;
    for (int i = 0; i < kRays; ++i) {
        Random random(8, 0, static_cast<uint32_t>(i));
        const Ray ray{.origin = {0.2, 0.01, 0.0}, .seed = random.bits(), .from_camera = true};
        covered += tracer->trace(ray, random).covered ? 1 : 0;
    }
    // Binomial: a deviation of √(.3 · .7 / 4000).
    EXPECT_NEAR(covered / double{kRays}, 0.3, 4.5 * std::sqrt(0.21 / kRays));
}

}  // namespace
}  // namespace vellus::hair::tracer
