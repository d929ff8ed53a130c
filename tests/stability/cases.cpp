#include "tests/stability/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "engine/platform/jobs.h"
#include "tests/stability/report.h"

namespace vellus::test {

namespace {

template <size_t N>
float pick(Random& random, const std::array<float, N>& values) {
    return values[random.bits() % N];
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kUlp = 1.0f / 8388608.0f;

/// Values whose jumps mean something: radiances, not thresholds or repaired garbage.
constexpr std::array<int, 7> kShading = {0, 1, 2, 3, 4, 10, 11};

void move_one_ulp(Random& random, ProbeInput& input) {
    const std::array<float*, 15> fields = {
        &input.color.x,   &input.color.y,    &input.color.z,    &input.tangent.x,  &input.tangent.y,
        &input.tangent.z, &input.to_light.x, &input.to_light.y, &input.to_light.z, &input.to_view.x,
        &input.to_view.y, &input.to_view.z,  &input.roughness,  &input.shift,      &input.shadow};
    float& field = *fields[random.bits() % fields.size()];
    // Towards the middle of the range, so that colours and shadows stay inside [0, 1].
    const float target =
        (&field >= &input.tangent.x && &field <= &input.to_view.z && (random.bits() & 1) != 0)
            ? -2.0f
            : 0.5f;
    field = std::nextafter(field, target);
}

struct Jump {
    double size = 0.0;
    int output = 0;
};

Jump jump(const ProbeOutput& a, const ProbeOutput& b) {
    Jump worst;
    for (const int row : kShading) {
        for (int i = 0; i < 3; ++i) {
            const double change = std::abs(static_cast<double>(a.value[row][i]) - b.value[row][i]);
            const double size = change / (std::abs(a.value[row][i]) + 0.05);
            if (size > worst.size) worst = {size, row};
        }
    }
    return worst;
}

}  // namespace

glm::vec3 inclined(Random& random, const glm::vec3& axis, double sine) {
    const glm::dvec3 u = glm::normalize(glm::dvec3(axis));
    const double s = std::clamp(sine, -1.0, 1.0);
    glm::dvec3 across = random.direction();
    across = glm::normalize(across - u * glm::dot(across, u));
    return u * s + across * std::sqrt(1.0 - s * s);
}

ProbeInput ordinary_input(Random& random) {
    ProbeInput p{};
    p.color = {random.unit(), random.unit(), random.unit()};
    p.roughness = static_cast<float>(random.range(0.05, 1.0));
    p.tangent = random.direction();
    p.specular = static_cast<float>(random.unit());
    p.to_light = random.direction();
    p.scatter = static_cast<float>(random.unit());
    p.to_view = random.direction();
    p.shift = static_cast<float>(random.range(-0.2, 0.2));
    p.history = {random.unit(), random.unit(), random.unit()};
    p.shadow = static_cast<float>(random.unit());
    p.receiver = static_cast<float>(random.range(0.0, 10.0));
    p.occluder = static_cast<float>(random.range(0.0, 10.0));
    p.falloff = static_cast<float>(random.log_range(0.1, 1e3));
    p.blend = static_cast<float>(random.unit());
    return p;
}

ProbeInput extreme_input(Random& random) {
    ProbeInput p = ordinary_input(random);
    const auto direction = [&]() -> glm::vec3 {
        switch (random.bits() % 8) {
            case 0:
                return p.tangent;
            case 1:
                return -p.tangent;
            case 2:
                return p.tangent * (1.0f + kUlp);
            case 3:
                return p.tangent * (kUlp - 1.0f);
            case 4:
                return inclined(random, p.tangent, 1.0 - random.log_range(1e-14, 1e-2));
            case 5:
                return inclined(random, p.tangent, random.log_range(1e-14, 1e-2) - 1.0);
            case 6:
                return inclined(random, p.tangent, 0.0);
            default:
                return random.direction();
        }
    };
    p.to_light = direction();
    p.to_view = (random.bits() % 4 == 0) ? ((random.bits() & 1) != 0 ? -p.to_light : p.to_light)
                                         : direction();
    if (random.bits() % 16 == 0) p.tangent = glm::vec3(0.0f);
    const std::array<float, 7> colors = {0.0f, 1e-40f, 1e-30f, 1e-7f, 0.5f, 1.0f - 0.5f * kUlp,
                                         1.0f};
    p.color = {pick(random, colors), pick(random, colors), pick(random, colors)};
    p.roughness = pick<7>(random, {0.0f, 1e-3f, 1e-2f, 0.045f, 0.3f, 1.0f, 1e-20f});
    p.shift = pick<5>(random, {0.0f, -0.2f, 0.2f, 1e-7f, 0.035f});
    p.shadow = pick<4>(random, {0.0f, 1.0f, 1e-30f, 0.5f});
    p.blend = pick<4>(random, {0.0f, 1.0f, 0.1f, 1e-30f});
    const std::array<float, 6> lengths = {0.0f, 1e-30f, 1e-3f, 1.0f, 1e4f, 1e30f};
    p.receiver = pick(random, lengths);
    p.occluder = pick(random, lengths);
    p.falloff = pick(random, lengths);
    const std::array<float, 9> garbage = {std::nanf(""), kInfinity, -kInfinity, 1e6f,  65504.0f,
                                          1e30f,         -1.0f,     0.0f,       1e-40f};
    p.history = {pick(random, garbage), pick(random, garbage), pick(random, garbage)};
    return p;
}

std::string describe(const ProbeInput& p) {
    return fmt::format(
        "C ({:.3g} {:.3g} {:.3g}) r {:.3g} shift {:.3g} sin i {:.8g} sin r {:.8g} i·r {:.8g}",
        p.color.x, p.color.y, p.color.z, p.roughness, p.shift, glm::dot(p.tangent, p.to_light),
        glm::dot(p.tangent, p.to_view), glm::dot(p.to_light, p.to_view));
}

void expect_finite(const std::string& area, const std::string& test, const Generator& generator,
                   size_t count) {
    std::mutex mutex;
    double bad = 0.0;
    std::string input = "-";
    parallel_ranges(count, 4096, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            Random random(11, i);
            const ProbeInput p = generator(random);
            const ProbeOutput out = hair::probe::probe(p, static_cast<uint32_t>(i));
            for (const glm::vec4& value : out.value) {
                for (int c = 0; c < 4; ++c) {
                    if (std::isfinite(value[c]) && value[c] >= 0.0f) continue;
                    const std::scoped_lock lock(mutex);
                    bad += 1.0;
                    input = fmt::format("output {}.{} = {}: {}", &value - out.value, c, value[c],
                                        describe(p));
                }
            }
        }
    });
    report_row({area, test + ": finite, >= 0", input, bad, 0.0});
}

void expect_continuous(const std::string& area, const std::string& test, const Generator& generator,
                       double bound, size_t count) {
    std::mutex mutex;
    Worst worst;
    parallel_ranges(count, 4096, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            Random random(13, i);
            const ProbeInput p = generator(random);
            ProbeInput moved = p;
            move_one_ulp(random, moved);
            const Jump change = jump(hair::probe::probe(p, 1), hair::probe::probe(moved, 1));
            if (change.size < 1e-5) continue;
            const std::scoped_lock lock(mutex);
            worst.add(change.size,
                      [&] { return fmt::format("output {}: {}", change.output, describe(p)); });
        }
    });
    worst.report(area, test + ": +-1 ulp", bound);
}

}  // namespace vellus::test
