#include "modules/hair/reference/tracer/environment_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/light/light_glsl.h"

namespace vellus::hair::tracer {

namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 texel(const asset::ImageF& image, int64_t column, int64_t row) {
    const int64_t width = image.width;
    const int64_t height = image.height;
    const int64_t x = ((column % width) + width) % width;
    const int64_t y = ((row % height) + height) % height;  // the device's sampler repeats both ways
    const float* rgba = image.rgba.data() + 4 * (y * width + x);
    return {rgba[0], rgba[1], rgba[2]};
}

double brightness(const glm::dvec3& c) {
    return (c.x + c.y + c.z) / 3.0;
}

/// Mean brightness over the texel of the bilinear interpolation between texel centres.
double spread_brightness(const asset::ImageF& image, int64_t column, int64_t row) {
    constexpr std::array<double, 3> kWeight = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (int64_t y = -1; y <= 1; ++y) {
        for (int64_t x = -1; x <= 1; ++x) {
            sum += kWeight[x + 1] * kWeight[y + 1] * brightness(texel(image, column + x, row + y));
        }
    }
    return sum;
}

/// Solid angle of a texel of this row.
double texel_angle(const asset::ImageF& image, size_t row) {
    const double top = std::sin(kPi * (0.5 - static_cast<double>(row) / image.height));
    const double bottom = std::sin(kPi * (0.5 - (static_cast<double>(row) + 1.0) / image.height));
    return (top - bottom) * 2.0 * kPi / image.width;
}

/// The step of a cumulative column that holds `u`, and how far into it.
size_t find_step(const double* share, size_t steps, double u, double& within) {
    const double* after = std::upper_bound(share, share + steps + 1, u);
    size_t step = after == share ? 0 : static_cast<size_t>(after - share) - 1;
    step = std::min(step, steps - 1);
    while (step > 0 && share[step + 1] <= share[step]) --step;  // u at the very end
    const double size = share[step + 1] - share[step];
    within = size > 0.0 ? std::clamp((u - share[step]) / size, 0.0, 1.0) : 0.5;
    return step;
}

void accumulate(double* share, size_t steps) {
    for (size_t i = 0; i < steps; ++i) share[i + 1] += share[i];
    const double total = share[steps];
    for (size_t i = 1; i <= steps && total > 0.0; ++i) share[i] /= total;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : pixels_(environment.pixels),
      intensity_(environment.intensity),
      turn_(std::cos(environment.rotation), std::sin(environment.rotation)) {
    const size_t width = pixels_.width;
    const size_t height = pixels_.height;
    row_share_.assign(height + 1, 0.0);
    column_share_.assign(height * (width + 1), 0.0);
    for (size_t row = 0; row < height; ++row) {
        double* columns = column_share_.data() + row * (width + 1);
        for (size_t column = 0; column < width; ++column) {
            columns[column + 1] =
                spread_brightness(pixels_, static_cast<int64_t>(column), static_cast<int64_t>(row));
            row_share_[row + 1] += columns[column + 1] * texel_angle(pixels_, row);
        }
        accumulate(columns, width);
    }
    accumulate(row_share_.data(), height);
    if (!(row_share_.back() > 0.0) || intensity_ <= 0.0) row_share_.clear();
}

glm::dvec3 EnvironmentLight::to_image(const glm::dvec3& d) const {
    // The image turns counter-clockwise, so the direction looked up turns back (sky.frag.glsl).
    return {turn_.x * d.x - turn_.y * d.z, d.y, turn_.y * d.x + turn_.x * d.z};
}

glm::dvec3 EnvironmentLight::radiance(const glm::dvec3& direction) const {
    if (black()) return glm::dvec3(0.0);
    const glm::dvec2 uv(light::glsl::equirect_uv(glm::vec3(to_image(direction))));
    const glm::dvec2 at = uv * glm::dvec2(pixels_.width, pixels_.height) - 0.5;
    const glm::dvec2 corner = glm::floor(at);
    const glm::dvec2 f = at - corner;
    const auto x = static_cast<int64_t>(corner.x);
    const auto y = static_cast<int64_t>(corner.y);
    const glm::dvec3 top = glm::mix(texel(pixels_, x, y), texel(pixels_, x + 1, y), f.x);
    const glm::dvec3 bottom = glm::mix(texel(pixels_, x, y + 1), texel(pixels_, x + 1, y + 1), f.x);
    return glm::mix(top, bottom, f.y) * intensity_;
}

double EnvironmentLight::texel_pdf(size_t row, size_t column) const {
    const double* columns = column_share_.data() + row * (pixels_.width + size_t{1});
    return (row_share_[row + 1] - row_share_[row]) * (columns[column + 1] - columns[column]) /
           texel_angle(pixels_, row);
}

EnvironmentLight::Sample EnvironmentLight::sample(const glm::dvec2& u) const {
    double down = 0.0;
    double right = 0.0;
    const size_t row = find_step(row_share_.data(), pixels_.height, u.y, down);
    const size_t column = find_step(column_share_.data() + row * (pixels_.width + size_t{1}),
                                    pixels_.width, u.x, right);
    const double height = pixels_.height;
    const double top = std::sin(kPi * (0.5 - static_cast<double>(row) / height));
    const double bottom = std::sin(kPi * (0.5 - (static_cast<double>(row) + 1.0) / height));
    const double y = glm::mix(top, bottom, down);
    const double across = std::sqrt(std::max(1.0 - y * y, 0.0));
    const double longitude =
        2.0 * kPi * (0.5 - (static_cast<double>(column) + right) / pixels_.width);
    const glm::dvec3 d(across * std::sin(longitude), y, across * std::cos(longitude));
    return {{turn_.x * d.x + turn_.y * d.z, d.y, -turn_.y * d.x + turn_.x * d.z},
            texel_pdf(row, column)};
}

double EnvironmentLight::pdf(const glm::dvec3& direction) const {
    if (black()) return 0.0;
    const glm::dvec2 uv(light::glsl::equirect_uv(glm::vec3(to_image(direction))));
    const auto column = static_cast<size_t>(std::clamp(uv.x, 0.0, 1.0) * pixels_.width);
    const auto row = static_cast<size_t>(std::clamp(uv.y, 0.0, 1.0) * pixels_.height);
    return texel_pdf(std::min<size_t>(row, pixels_.height - 1),
                     std::min<size_t>(column, pixels_.width - 1));
}

}  // namespace vellus::hair::tracer
