#include "modules/hair/reference/tracer/film.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "modules/hair/reference/tracer/render.h"
#include "tests/unit/tracer/scenes.h"

namespace vellus::hair::tracer {
namespace {

std::unique_ptr<PathTracer> small_tracer() {
    Scene scene;
    scene.grooms.push_back(test::make_ball({0, 0, -1}, 0.2f, 100, 0.005f));
    scene.environment = test::uneven_environment();
    return test::make_tracer(std::move(scene));
}

const std::atomic<bool> kNeverStop = false;

TEST(Film, OneThreadAndManyGiveTheSameBits) {
    const auto tracer = small_tracer();
    Film many({50, 37});
    add_samples(*tracer, 5, 3, many, kNeverStop);
    Film one({50, 37});
    {
        const oneapi::tbb::global_control limit(
            oneapi::tbb::global_control::max_allowed_parallelism, 1);
        add_samples(*tracer, 5, 3, one, kNeverStop);
    }
    EXPECT_EQ(many.checkpoint(0), one.checkpoint(0));
    Film other({50, 37});
    add_samples(*tracer, 6, 3, other, kNeverStop);
    EXPECT_NE(many.checkpoint(0), other.checkpoint(0));
}

TEST(Film, GoingOnFromACheckpointGivesTheSameBits) {
    const auto tracer = small_tracer();
    Film whole({20, 16});
    add_samples(*tracer, 5, 6, whole, kNeverStop);
    Film part({20, 16});
    add_samples(*tracer, 5, 2, part, kNeverStop);
    auto again = Film::from_checkpoint(part.checkpoint(77), 77);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->complete(), 2u);
    add_samples(*tracer, 5, 6, *again, kNeverStop);
    EXPECT_EQ(whole.checkpoint(0), again->checkpoint(0));
}

TEST(Film, StopsWithWholePixels) {
    const auto tracer = small_tracer();
    Film film({20, 16});
    const std::atomic<bool> stopped = true;
    add_samples(*tracer, 5, 6, film, stopped);
    EXPECT_EQ(film.complete(), 0u);
}

TEST(Film, CheckpointsOfOtherPicturesAreRefused) {
    const Film film({4, 4});
    const auto bytes = film.checkpoint(1);
    EXPECT_FALSE(Film::from_checkpoint(bytes, 2));
    EXPECT_FALSE(Film::from_checkpoint(std::span(bytes).first(bytes.size() - 1), 1));
    EXPECT_FALSE(Film::from_checkpoint(std::span(bytes).first(5), 1));
    auto wrong = bytes;
    wrong[0] ^= std::byte{1};
    EXPECT_FALSE(Film::from_checkpoint(wrong, 1));
    EXPECT_TRUE(Film::from_checkpoint(bytes, 1));
}

TEST(Film, MeanAndErrorAreThoseOfTheSamples) {
    Film film({1, 1});
    const std::vector<double> values = {1.0, 4.0, 2.0, 7.0, 3.0};
    for (size_t i = 0; i < values.size(); ++i) {
        film.add(0,
                 {.radiance = glm::dvec3(values[i], 2.0, 0.0), .covered = i < 4, .hair = i == 1});
    }
    // Mean 3.4, squared deviations 5.76 + .36 + 1.96 + 12.96 + .16 = 21.2.
    EXPECT_NEAR(film.mean(0).x, 3.4, 1e-15);
    EXPECT_NEAR(film.standard_error(0).x, std::sqrt(21.2 / 4.0 / 5.0), 1e-12);
    EXPECT_NEAR(film.standard_error(0).y, 0.0, 1e-12);
    EXPECT_DOUBLE_EQ(film.coverage(0), 0.8);
    EXPECT_DOUBLE_EQ(film.hair(0), 0.2);
    const asset::PlaneImage planes = film.planes();
    EXPECT_FLOAT_EQ(planes.find("R")->values[0], 3.4f);
    EXPECT_FLOAT_EQ(planes.find("error.R")->values[0], std::sqrt(21.2f / 20.0f));
    EXPECT_FLOAT_EQ(planes.find("A")->values[0], 0.8f);
    EXPECT_FLOAT_EQ(planes.find("hair")->values[0], 0.2f);
}

TEST(Scene, HashSeesEveryPart) {
    Scene scene;
    scene.grooms.push_back(test::make_ball({0, 0, -1}, 0.2f, 3, 0.005f));
    scene.lights.push_back({});
    scene.environment = test::uneven_environment();
    const uint64_t before = hash(scene);
    EXPECT_EQ(hash(scene), before);
    const auto changed = [&](const auto& change) {
        Scene other = scene;
        change(other);
        return hash(other) != before;
    };
    EXPECT_TRUE(changed([](Scene& s) { s.camera.near_plane += 1e-9; }));
    EXPECT_TRUE(changed([](Scene& s) { s.grooms[0].points[1].x += 1e-6f; }));
    EXPECT_TRUE(changed([](Scene& s) { s.grooms[0].light.multiple = false; }));
    EXPECT_TRUE(changed([](Scene& s) { s.meshes.emplace_back(); }));
    EXPECT_TRUE(changed([](Scene& s) { s.lights[0].color.x = 1e-9; }));
    EXPECT_TRUE(changed([](Scene& s) { s.environment->pixels.rgba[5] += 1.0f; }));
}

}  // namespace
}  // namespace vellus::hair::tracer
