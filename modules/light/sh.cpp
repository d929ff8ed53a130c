#include "modules/light/sh.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/platform/jobs.h"

namespace vellus::light {

namespace {

constexpr double kLargestHalf = 65504.0;

constexpr std::array<double, 9> kNormalisation = {
    0.28209479177387814, 0.4886025119029199, 0.4886025119029199,
    0.4886025119029199,  1.0925484305920792, 1.0925484305920792,
    0.3153915652525201,  1.0925484305920792, 0.5462742152960396};

double usable(float channel) {
    if (std::isnan(channel) || channel < 0.0f) return 0.0;
    return std::isinf(channel) ? kLargestHalf : static_cast<double>(channel);
}

/// Sum of radiance times the basis over one row, all texels weighted alike.
ShRadiance project_row(const asset::ImageF& image, uint32_t row,
                       const std::vector<glm::dvec2>& azimuth) {
    const double latitude = (0.5 - (row + 0.5) / image.height) * std::numbers::pi;
    const double y = std::sin(latitude);
    const double across = std::cos(latitude);
    ShRadiance sum{};
    const float* texel = image.rgba.data() + size_t{row} * image.width * 4;
    for (uint32_t column = 0; column < image.width; ++column, texel += 4) {
        const glm::dvec3 radiance(usable(texel[0]), usable(texel[1]), usable(texel[2]));
        const double x = across * azimuth[column].x;
        const double z = across * azimuth[column].y;
        const std::array<double, 9> basis = {
            1.0, x, y, z, x * y, y * z, 3.0 * y * y - 1.0, x * z, z * z - x * x};
        for (size_t i = 0; i < 9; ++i) sum[i] += radiance * basis[i];
    }
    return sum;
}

}  // namespace

ShRadiance project_sh(const asset::ImageF& equirect) {
    ShRadiance total{};
    if (equirect.width == 0 || equirect.height == 0) return total;
    std::vector<glm::dvec2> azimuth(equirect.width);
    for (uint32_t column = 0; column < equirect.width; ++column) {
        const double longitude = (0.5 - (column + 0.5) / equirect.width) * 2.0 * std::numbers::pi;
        azimuth[column] = {std::sin(longitude), std::cos(longitude)};
    }
    std::vector<ShRadiance> rows(equirect.height);
    parallel_ranges(rows.size(), 16, [&](size_t first, size_t last) {
        for (size_t row = first; row < last; ++row) {
            rows[row] = project_row(equirect, static_cast<uint32_t>(row), azimuth);
        }
    });
    for (uint32_t row = 0; row < equirect.height; ++row) {
        const double top = (0.5 - static_cast<double>(row) / equirect.height) * std::numbers::pi;
        const double bottom = (0.5 - (row + 1.0) / equirect.height) * std::numbers::pi;
        const double solid_angle =
            2.0 * std::numbers::pi / equirect.width * (std::sin(top) - std::sin(bottom));
        for (size_t i = 0; i < 9; ++i) total[i] += rows[row][i] * (solid_angle * kNormalisation[i]);
    }
    return total;
}

ShRadiance rotate_about_y(const ShRadiance& radiance, double radians) {
    ShRadiance turned = radiance;
    const auto turn = [&](size_t sine, size_t cosine, double angle) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        turned[sine] = radiance[sine] * c + radiance[cosine] * s;
        turned[cosine] = radiance[cosine] * c - radiance[sine] * s;
    };
    turn(1, 3, radians);
    turn(4, 5, radians);
    turn(7, 8, 2.0 * radians);
    return turned;
}

glsl::Sh9 irradiance_over_pi(const ShRadiance& radiance, double scale) {
    constexpr std::array<double, 9> lobe = {1.0,  2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25,
                                            0.25, 0.25,      0.25,      0.25};
    glsl::Sh9 sh{};
    for (size_t i = 0; i < 9; ++i) {
        sh.c[i] = glm::vec3(radiance[i] * (scale * lobe[i] * kNormalisation[i]));
    }
    return sh;
}

}  // namespace vellus::light
