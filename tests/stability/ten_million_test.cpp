#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "engine/platform/jobs.h"
#include "tests/stability/cases.h"
#include "tests/stability/report.h"
#include "tests/stability/shading_functions.h"

// Ten million inputs through every shading function, half of them ordinary, half of extremes and
// denormals: finite, not negative, and as far from the same code in double as rounding explains.
namespace vellus::test {
namespace {

constexpr size_t kInputs = 10'000'000;
constexpr float kDenormal = 1e-42f;

/// A field in eight becomes a denormal; directions stay unit within their rounding.
void sprinkle_denormals(Random& random, ProbeInput& p) {
    const std::array<float*, 13> fields = {
        &p.color.x, &p.color.y, &p.color.z,  &p.roughness, &p.specular, &p.scatter,  &p.shift,
        &p.shadow,  &p.blend,   &p.receiver, &p.occluder,  &p.falloff,  &p.tangent.x};
    for (float* field : fields) {
        if (random.bits() % 8 != 0) continue;
        if (field != &p.tangent.x) *field = kDenormal;
        if (field == &p.tangent.x) p.tangent = {kDenormal, 0.0f, 1.0f};
    }
}

ShadingInput make_input(size_t i) {
    Random random(91, i);
    ProbeInput p = (i & 1) != 0 ? extreme_input(random) : ordinary_input(random);
    if (i % 4 == 3) sprinkle_denormals(random, p);
    return {p.color,    p.tangent,  p.to_light,
            p.to_view,  p.history,  p.roughness,
            p.specular, p.scatter,  p.shift,
            p.shadow,   p.receiver, p.occluder,
            p.falloff,  p.blend,    fibre_floats(random.bits() % kFibres, p.roughness, p.shift)};
}

std::string describe(const ShadingInput& p) {
    return fmt::format(
        "C {:.3g} {:.3g} {:.3g} r {:.3g} shift {:.3g} sin i {:.8g} sin r {:.8g} i·r {:.8g} "
        "shadow {:.3g} depths {:.3g} {:.3g} falloff {:.3g}",
        p.color.x, p.color.y, p.color.z, p.roughness, p.shift, glm::dot(p.tangent, p.to_light),
        glm::dot(p.tangent, p.to_view), glm::dot(p.to_light, p.to_view), p.shadow, p.receiver,
        p.occluder, p.falloff);
}

template <class V>
bool is_fine(const V& value) {
    for (int c = 0; c < 4; ++c) {
        if (!std::isfinite(value[c]) || value[c] < 0) return false;
    }
    return true;
}

/// Largest change of the double where a component of a direction moves by an ulp of 1.
glm::dvec4 sensitivity(int function, const ShadingInput& p, const glm::dvec4& exact) {
    constexpr float kUlp = 1.0f / 8388608.0f;
    glm::dvec4 most(0.0);
    for (int component = 0; component < 18; ++component) {
        ShadingInput moved = p;
        glm::vec3& direction = component < 6    ? moved.tangent
                               : component < 12 ? moved.to_light
                                                : moved.to_view;
        direction[component % 3] += component % 6 < 3 ? kUlp : -kUlp;
        most = glm::max(most, glm::abs(in_double::evaluate(function, moved) - exact));
    }
    return most;
}

constexpr double kFloor = 0.05;     // of values whose peaks are 1 and more
constexpr double kOrdinary = 1e-3;  // below it nobody asks why

/// |float - double| over the value and the floor, less what four ulps of the directions and one of
/// the azimuth's cosine do to lobes that are 1e-3 wide and reach 1e6 at the fibre's poles.
double rounding_error(int function, const ShadingInput& p, const glm::vec4& single,
                      const glm::dvec4& exact) {
    const glm::dvec4 off = glm::abs(glm::dvec4(single) - exact);
    const auto worst = [&](const glm::dvec4& part) {
        const glm::dvec4 error = part / (exact + kFloor);
        return std::max(std::max(error.x, error.y), std::max(error.z, error.w));
    };
    if (worst(off) <= kOrdinary) return worst(off);
    // A HairFibre begins with 1/v of R, TT, TRT.
    const double peak = *std::max_element(p.fibre.begin(), p.fibre.begin() + 3);
    const glm::dvec4 allowed = 4.0 * sensitivity(function, p, exact) + 1.2e-7 * peak;
    return std::max(worst(off - allowed), kOrdinary);
}

class TenMillion : public testing::TestWithParam<int> {};

TEST_P(TenMillion, FiniteNotNegativeAndNearTheDouble) {
    const int function = GetParam();
    std::mutex mutex;
    double largest = 0.0;
    size_t largest_at = 0;
    size_t bad = 0;
    size_t bad_at = 0;
    parallel_ranges(kInputs, 16384, [&](size_t first, size_t last) {
        double mine = -1.0;
        size_t at = first;
        size_t mine_bad = 0;
        size_t mine_bad_at = 0;
        for (size_t i = first; i < last; ++i) {
            const ShadingInput p = make_input(i);
            const glm::vec4 single = in_float::evaluate(function, p);
            const glm::dvec4 exact = in_double::evaluate(function, p);
            const bool fine = is_fine(single) && is_fine(exact);
            if (!fine) mine_bad_at = i;
            if (!fine) ++mine_bad;
            const double error = fine ? rounding_error(function, p, single, exact) : 0.0;
            if (error > mine) at = i;
            mine = std::max(mine, error);
        }
        const std::scoped_lock lock(mutex);
        bad += mine_bad;
        if (mine_bad != 0) bad_at = mine_bad_at;
        // The same worst input whichever thread comes first.
        if (mine > largest || (mine == largest && at < largest_at)) largest_at = at;
        largest = std::max(largest, mine);
    });
    const std::string name = kShadingFunctions[function];
    report_row({"10 million", name + ": not finite or < 0",
                bad == 0 ? "-" : describe(make_input(bad_at)), static_cast<double>(bad), 0.0});
    report_row(
        {"10 million", name + ": float - double", describe(make_input(largest_at)), largest, 0.02});
}

INSTANTIATE_TEST_SUITE_P(Functions, TenMillion,
                         testing::Range(0, static_cast<int>(kShadingFunctions.size())),
                         [](const auto& param) { return kShadingFunctions[param.param]; });

}  // namespace
}  // namespace vellus::test
