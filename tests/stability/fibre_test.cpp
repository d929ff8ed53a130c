#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <mutex>

#include "engine/platform/jobs.h"
#include "modules/hair/scattering/fibre.h"
#include "tests/stability/report.h"
#include "tests/support/sampling.h"

// The techniques beside Karis's are continuous; that they are finite is in ten_million_test.cpp.
namespace vellus::test {
namespace {

using namespace hair::glsl;  // NOLINT(google-build-using-namespace)

struct Input {
    HairSurface surface;
    glm::vec3 tangent, to_light, to_view;
    float shadow, behind;
    uint32_t optics;
};

constexpr std::array<hair::FibreOptics, 4> kOptics = {
    {{}, {1.1f, 0.3f, 0.14f}, {3.0f, 1.3f, 0.55f}, {1.33f, 0.63f, 0.27f}}};

const std::array<HairFibre, 4>& fitted() {
    static const auto fibres = [] {
        std::array<HairFibre, 4> all{};
        for (size_t i = 0; i < all.size(); ++i) hair::fit_azimuthal(kOptics[i], all[i]);
        return all;
    }();
    return fibres;
}

Input ordinary(Random& random) {
    return {.surface = {{random.unit(), random.unit(), random.unit()},
                        static_cast<float>(random.unit()),
                        static_cast<float>(random.range(0.05, 1.0)),
                        static_cast<float>(random.unit()),
                        static_cast<float>(random.range(-0.2, 0.2))},
            .tangent = random.direction(),
            .to_light = random.direction(),
            .to_view = random.direction(),
            .shadow = static_cast<float>(random.unit()),
            .behind = static_cast<float>(random.range(0.0, 20.0)),
            .optics = static_cast<uint32_t>(random.bits() % kOptics.size())};
}

/// The techniques of single scattering, then dual scattering alone.
glm::vec3 evaluate(int technique, const Input& p) {
    HairFibre fibre = fitted()[p.optics];
    hair::set_longitudinal(p.surface.roughness, p.surface.shift, fibre);
    const HairFrame f = hair_frame(p.tangent, p.to_view);
    const HairEye e = hair_eye(fibre, f);
    if (technique == kScatteringCount) {
        return dual_scattering(fibre, p.surface, f, e, p.to_light, p.shadow, p.behind);
    }
    return hair_bsdf(technique, fibre, p.surface, f, e, p.to_light);
}

constexpr std::array<const char*, kScatteringCount + 1> kNames = {
    "karis",     "kajiya_kay", "marschner",    "karis_rational", "series_gaussian",
    "series_a2", "series_b",   "series_exact", "deon",           "dual"};

std::string describe(const Input& p) {
    return fmt::format("C {:.3g} {:.3g} {:.3g} r {:.3g} η {} sin i {:.8g} sin r {:.8g} i·r {:.8g}",
                       p.surface.base_color.x, p.surface.base_color.y, p.surface.base_color.z,
                       p.surface.roughness, kOptics[p.optics].eta, glm::dot(p.tangent, p.to_light),
                       glm::dot(p.tangent, p.to_view), glm::dot(p.to_light, p.to_view));
}

TEST(Fibre, EveryTechniqueIsContinuous) {
    for (int t = 0; t <= kScatteringCount; ++t) {
        std::mutex mutex;
        Worst worst;
        parallel_ranges(
            t == kScatteringDeon ? 50'000 : 300'000, 4096, [&](size_t first, size_t last) {
                for (size_t i = first; i < last; ++i) {
                    Random random(52, i);
                    const Input p = ordinary(random);
                    Input moved = p;
                    const std::array<float*, 10> fields = {
                        &moved.tangent.x,           &moved.tangent.y,  &moved.tangent.z,
                        &moved.to_light.x,          &moved.to_light.y, &moved.to_light.z,
                        &moved.to_view.x,           &moved.to_view.y,  &moved.to_view.z,
                        &moved.surface.base_color.x};
                    float& field = *fields[random.bits() % fields.size()];
                    field = std::nextafter(field, 0.5f);
                    const glm::vec3 a = evaluate(t, p);
                    const glm::vec3 b = evaluate(t, moved);
                    for (int c = 0; c < 3; ++c) {
                        const double jump = std::abs(a[c] - b[c]) / (std::abs(a[c]) + 0.05);
                        if (jump < 1e-5) continue;
                        const std::scoped_lock lock(mutex);
                        worst.add(jump, [&] { return describe(p); });
                    }
                }
            });
        // As for Karis's: an ulp over the narrowest lobe and the fade of the azimuth.
        worst.report("scattering", fmt::format("{}: +-1 ulp", kNames[t]), 0.01);
    }
}

}  // namespace
}  // namespace vellus::test
