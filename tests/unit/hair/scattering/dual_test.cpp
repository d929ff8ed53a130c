#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <numbers>

#include "engine/platform/jobs.h"
#include "modules/hair/reference/chiang.h"
#include "modules/hair/reference/dual_scattering.h"
#include "modules/hair/reference/dual_volume.h"
#include "modules/hair/reference/quadrature.h"
#include "modules/hair/scattering/fibre.h"
#include "tests/support/sampling.h"

namespace vellus::hair {
namespace {

constexpr double kPi = std::numbers::pi;

glsl::HairFibre fibre_of(const glsl::HairSurface& s) {
    glsl::HairFibre fibre{};
    fit_azimuthal({}, fibre);
    set_longitudinal(s.roughness, s.shift, fibre);
    return fibre;
}

/// What Chiang's fibre sends into its residual lobe, which is even around the fibre: mean over h.
double residual(float color, double theta) {
    constexpr int kSteps = 400;
    const auto fibre = reference::chiang_from_karis(glm::dvec3(color), 0.3, 0.0);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double h = -1.0 + (2.0 * i + 1.0) / kSteps;
        const reference::ChiangScattering at_h(fibre, h, {std::sin(theta), std::cos(theta)});
        sum += at_h.attenuation()[3].x / kSteps;
    }
    return sum;
}

TEST(Dual, AveragesAreTheReferences) {
    for (const float color : {0.005f, 0.1f, 0.5f, 1.0f}) {
        const glsl::HairSurface s{glm::vec3(color), 0.5f, 0.3f, 1.0f, 0.0f};
        const auto fibre = fibre_of(s);
        for (const double theta : {0.0, 0.5, 1.0, 1.3}) {
            auto exact = reference::dual_averages(reference::karis_fibre(s, 0), theta);
            const double rest = residual(color, theta);
            exact.forward += 0.5 * rest;
            exact.backward += 0.5 * rest;
            const double cos2_t = 1.0 - std::pow(std::sin(theta) / 1.55, 2.0);
            const auto half_log = static_cast<float>(std::log2(color) * 0.5 / std::sqrt(cos2_t));
            const auto a = glsl::hair_averages(fibre, s, glm::vec3(half_log),
                                               static_cast<float>(std::cos(theta)));
            // θd varies over the lobes, which the shader leaves out, the more the closer to
            // grazing.
            EXPECT_NEAR(a.forward.x, exact.forward, 0.015) << color << " " << theta;
            EXPECT_NEAR(a.backward.x, exact.backward, 0.015) << color << " " << theta;
            if (color == 1.0f) {
                EXPECT_NEAR(a.forward.x + a.backward.x, 1.0f, 1e-3f) << theta;
            }
            EXPECT_NEAR(a.forward_variance / exact.forward_variance, 1.0, 0.25);
            EXPECT_NEAR(a.backward_variance / exact.backward_variance, 1.0, 0.25);
            const auto back = glsl::dual_backscatter(glm::vec3(static_cast<float>(exact.forward)),
                                                     glm::vec3(static_cast<float>(exact.backward)),
                                                     glm::vec3(0.0f));
            EXPECT_NEAR(back.x, reference::backscatter_all_orders(exact.forward, exact.backward),
                        2e-3);
        }
    }
}

TEST(Dual, OnwardLightSolvesTheTwoStreams) {
    // F' = -(1 - f) F + b B, -B' = -(1 - f) B + b F, stepped from the far end, where B = 0, by the
    // classic method of fourth order.
    for (const auto& [f, b] : {std::pair{0.65, 0.3499}, {0.5, 0.3}, {0.3, 0.02}, {0.9, 0.05}}) {
        for (const double behind : {0.0, 0.5, 3.0, 12.0}) {
            for (const double n : {0.0, 0.2, 2.0, 8.0}) {
                constexpr int kSteps = 2000;
                const auto towards_light = [&, f = f, b = b](const glm::dvec2& flux) {
                    return glm::dvec2((1.0 - f) * flux.x - b * flux.y,
                                      b * flux.x - (1.0 - f) * flux.y);
                };
                const auto march = [&](glm::dvec2 flux, double fibres) {
                    const double h = fibres / kSteps;
                    for (int i = 0; i < kSteps; ++i) {
                        const auto k1 = towards_light(flux);
                        const auto k2 = towards_light(flux + 0.5 * h * k1);
                        const auto k3 = towards_light(flux + 0.5 * h * k2);
                        const auto k4 = towards_light(flux + h * k3);
                        flux += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
                    }
                    return flux;
                };
                const glm::dvec2 here = march({1.0, 0.0}, behind);
                const glm::dvec2 first = march(here, n);
                const glm::vec3 forward(static_cast<float>(f)), backward(static_cast<float>(b));
                const glm::vec3 k = glsl::dual_fading(forward, backward);
                const auto onward =
                    glsl::dual_onward(forward, backward, k, static_cast<float>(n),
                                      glsl::dual_end(k, static_cast<float>(behind)));
                // Floats: 1 - r² of hair that absorbs next to nothing.
                EXPECT_NEAR(onward.x, here.x / first.x, 2e-4) << f << " " << behind << " " << n;
            }
        }
    }
}

TEST(Dual, BackscatterEndsWhereTheHairDoes) {
    for (const auto& [f, b] : {std::pair{0.65, 0.3499}, {0.5, 0.3}, {0.3, 0.02}, {0.8, 0.1}}) {
        const glm::vec3 forward(static_cast<float>(f)), backward(static_cast<float>(b));
        const glm::vec3 k = glsl::dual_fading(forward, backward);
        const auto back = [&](int fibres) {
            const auto end = glsl::dual_end(k, static_cast<float>(fibres));
            return glsl::dual_backscatter(forward, backward, end).x;
        };
        EXPECT_EQ(back(0), 0.0f);
        const auto through = [f = f, b = b](double r) { return f * f * r / (1.0 - b * r); };
        // Whole fibres one behind the other, added one by one, turn back more; as many at random
        // that absorb nothing, b n / (1 + b n), less.
        double whole = 0.0;
        for (int n = 1; n <= 40; ++n) {
            whole = b + through(whole);
            EXPECT_LE(back(n), through(whole) + 1e-5) << f << " " << n;
            EXPECT_GT(back(n), back(n - 1) - 1e-6f) << f << " " << n;
            if (f + b < 0.99) continue;
            EXPECT_GE(back(n), through(b * n / (1.0 + b * n)) - 1e-3) << f << " " << n;
        }
        EXPECT_NEAR(back(400), reference::backscatter_all_orders(f, b), 2e-3);
    }
}

TEST(Dual, SpreadLobeIsTheLobeBlurredOverTheFrontHalf) {
    const glsl::HairSurface s{{0.8f, 0.4f, 0.1f}, 0.5f, 0.4f, 1.0f, 0.02f};
    const auto fibre = fibre_of(s);
    const double theta_r = 0.2;
    const auto frame =
        glsl::hair_frame({1, 0, 0}, glm::vec3(std::sin(theta_r), 0.0, std::cos(theta_r)));
    const auto eye = glsl::hair_eye(fibre, frame);
    const auto light_at = [&](double phi) {
        return glm::vec3(std::sin(-0.25), std::cos(-0.25) * std::sin(phi),
                         std::cos(-0.25) * std::cos(phi));
    };
    for (const double phi : {0.0, 0.8, 1.6, 2.4, 3.1}) {
        const auto angles = glsl::hair_angles(frame, light_at(phi));
        const float cos2_t = 1.0f - (1.0f - angles.cos_d * angles.cos_d) * fibre.inverse_index2;
        const glm::vec3 half_log = glsl::hair_log2_color(s.base_color) * (0.5f / std::sqrt(cos2_t));
        const auto value = glsl::dual_spread_bsdf(fibre, s, eye, angles, half_log, 0.0f);
        glm::dvec3 blurred(0.0);
        constexpr int kSteps = 400;
        for (int i = 0; i < kSteps; ++i) {
            const double turned = phi + kPi * ((i + 0.5) / kSteps - 0.5);
            blurred += glm::dvec3(glsl::series_bsdf(glsl::kLongitudinalB, fibre, s, frame, eye,
                                                    light_at(turned))) /
                       static_cast<double>(kSteps);
        }
        for (int c = 0; c < 3; ++c) {
            // R's Fresnel factor at one mean cosine; TRT's clamp at 0.
            EXPECT_NEAR(value[c], blurred[c], 0.05 * blurred[c] + 0.01) << phi << " " << c;
        }
    }
}

TEST(Dual, IsNothingInFrontOfBlackHairAndFiniteEverywhere) {
    const glsl::HairSurface black{glm::vec3(0.0f), 0.5f, 0.3f, 1.0f, 0.035f};
    const auto fibre = fibre_of(black);
    const auto frame = glsl::hair_frame({1, 0, 0}, {0, 0, 1});
    const auto eye = glsl::hair_eye(fibre, frame);
    const auto lit =
        glsl::dual_scattering(fibre, black, frame, eye, {0, 0, 1}, 1.0f, glsl::kDualMostFibres);
    const auto single =
        glsl::series_bsdf(glsl::kLongitudinalB, fibre, black, frame, eye, {0, 0, 1});
    EXPECT_LT(lit.x, 0.05f * single.x);
    for (uint64_t i = 0; i < 300'000; ++i) {
        test::Random random(77, i);
        const float values[] = {0.0f, 1e-40f, 1e-7f, 0.3f, 0.999f, 1.0f};
        const auto pick = [&] { return values[random.bits() % 6]; };
        const glsl::HairSurface s{{pick(), pick(), pick()},
                                  pick(),
                                  pick(),
                                  1.0f,
                                  static_cast<float>(random.range(-0.2, 0.2))};
        glsl::HairFibre f = fibre;
        set_longitudinal(s.roughness, s.shift, f);
        const glm::vec3 tangent = random.direction();
        const glm::vec3 view = random.bits() % 5 == 0 ? tangent : glm::vec3(random.direction());
        const glm::vec3 light = random.bits() % 5 == 0 ? -tangent : glm::vec3(random.direction());
        const auto at = glsl::hair_frame(tangent, view);
        const auto value =
            glsl::dual_scattering(f, s, at, glsl::hair_eye(f, at), light, pick(), 100.0f * pick());
        for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(value[c]) && value[c] >= 0.0f) << i;
        }
    }
}

/// What the renderer shows of a slab: the closest fibre along the eye's ray, lit through
/// -ln(shadow) fibres.
glm::dvec3 shaded_slab(int scattering, int multiple, const glsl::HairSurface& s,
                       const glsl::HairFibre& fibre, double thickness,
                       const reference::SlabDirection& eye, const reference::SlabDirection& light) {
    const auto direction = [](const reference::SlabDirection& d) {
        return glm::vec3(std::sin(d.theta), std::cos(d.theta) * std::sin(d.phi),
                         std::cos(d.theta) * std::cos(d.phi));
    };
    const auto frame = glsl::hair_frame({1, 0, 0}, direction(eye));
    const auto turned = glsl::hair_eye(fibre, frame);
    const double cos_eye = std::cos(eye.phi);
    const double cos_light = std::cos(light.phi);
    const double most = std::min(thickness / cos_eye, 30.0);
    glm::dvec3 sum(0.0);
    const auto& rule = reference::gauss_rule(64);
    for (size_t i = 0; i < rule.node.size(); ++i) {
        const double t = 0.5 * most * (1.0 + rule.node[i]);
        const double depth = t * cos_eye;
        const double fibres =
            cos_light > 0.0 ? depth / cos_light : (thickness - depth) / -cos_light;
        const double behind = thickness / std::abs(cos_light) - fibres;
        sum += 0.5 * most * rule.weight[i] * std::exp(-t) *
               glm::dvec3(glsl::hair_direct(scattering, multiple, fibre, s, frame, turned,
                                            direction(light), static_cast<float>(std::exp(-fibres)),
                                            static_cast<float>(behind)));
    }
    return sum;
}

struct ColourError {
    double fake_normal = 0.0;
    double dual = 0.0;
};

/// Mean over views and lights of the relative error of colour, all channels.
ColourError colour_error(const glm::vec3& color) {
    const glsl::HairSurface s{color, 0.5f, 0.4f, 1.0f, 0.035f};
    const auto fibre = fibre_of(s);
    auto chiang = reference::chiang_from_karis(color, s.roughness, std::asin(0.035));
    struct View {
        double thickness;
        reference::SlabDirection eye, light;
    };
    std::vector<View> views;
    for (const double eye : {-0.6, 0.0, 0.6}) {
        for (const double theta : {-0.3, -0.1, 0.1, 0.3}) {
            views.push_back({1e3, {theta, eye}, {0.1, 0.0}});
            views.push_back({1e3, {theta, eye}, {0.1, 1.2}});
            views.push_back({3.0, {theta, eye}, {0.1, 2.6}});
        }
    }
    // Mean colours: over views of the same light, as one looks at a head.
    std::vector<glm::dvec3> truth(3), karis(3), dual(3);
    std::mutex mutex;
    parallel_ranges(views.size(), 1, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const View& view = views[i];
            const auto exact = reference::slab_radiance({chiang, view.thickness}, view.eye,
                                                        view.light, 2000, 100 + i);
            const auto by = [&](int scattering, int multiple) {
                return shaded_slab(scattering, multiple, s, fibre, view.thickness, view.eye,
                                   view.light);
            };
            const auto k = by(glsl::kScatteringKaris, glsl::kMultipleFakeNormal);
            const auto d = by(glsl::kScatteringSeriesB, glsl::kMultipleDual);
            const std::scoped_lock lock(mutex);
            truth[i % 3] += exact;
            karis[i % 3] += k;
            dual[i % 3] += d;
        }
    });
    ColourError error;
    for (int light = 0; light < 3; ++light) {
        const double scale = truth[light].x + truth[light].y + truth[light].z;
        const auto off = [&](const glm::dvec3& v) {
            const auto d = glm::abs(v - truth[light]);
            return (d.x + d.y + d.z) / scale;
        };
        error.fake_normal += off(karis[light]);
        error.dual += off(dual[light]);
    }
    return {error.fake_normal / 3.0, error.dual / 3.0};
}

TEST(Dual, MeanColourOfAVolumeOfFibres) {
    const auto light = colour_error({0.85f, 0.7f, 0.5f});
    const auto brown = colour_error({0.3f, 0.15f, 0.06f});
    const auto black = colour_error({0.02f, 0.015f, 0.01f});
    for (const auto& [name, error] :
         {std::pair{"light", light}, {"brown", brown}, {"black", black}}) {
        RecordProperty(std::string(name) + "_fake_normal", std::to_string(error.fake_normal));
        RecordProperty(std::string(name) + "_dual", std::to_string(error.dual));
    }
    // Issue: below half of Karis's on light hair, no worse on dark.
    EXPECT_LT(light.dual, 0.5 * light.fake_normal);
    EXPECT_LE(brown.dual, brown.fake_normal);
    EXPECT_LE(black.dual, black.fake_normal);
}

TEST(DualVolume, SingleScatteringIsItsIntegral) {
    // A half space seen and lit from in front: ∫ S e^(-t (1 + cos φo / cos φi)) dt.
    const auto fibre = reference::chiang_from_karis(glm::dvec3(0.5), 0.5, 0.0);
    const double cos_eye = std::cos(0.3);
    const double cos_light = std::cos(0.9);
    const auto value = reference::slab_radiance({fibre}, {0.1, 0.3}, {-0.2, 0.9}, 200'000, 3, true);
    const double mean = reference::integrate_gauss(-1.0, 1.0, 200, [&](double h) {
        const reference::ChiangScattering at(fibre, h, {std::sin(0.1), std::cos(0.1)});
        return 0.5 * at.evaluate({std::sin(-0.2), std::cos(-0.2)}, 0.6).x;
    });
    EXPECT_NEAR(value.x, mean / (1.0 + cos_eye / cos_light), 0.02 * value.x);
}

}  // namespace
}  // namespace vellus::hair
