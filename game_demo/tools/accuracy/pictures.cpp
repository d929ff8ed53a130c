#include "game_demo/tools/accuracy/pictures.h"

#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/common/portable.h"

namespace vellus::demo {

namespace glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/tonemap.glsl"
}  // namespace glsl

namespace {

constexpr double kMiddle = 0.3;  // mean brightness of hair after exposure
constexpr float kMostExposure = 1000.0f;
constexpr int kJpegQuality = 88;

constexpr std::array kMagma = {glm::vec3(0, 0, 4), glm::vec3(81, 18, 124), glm::vec3(183, 55, 121),
                               glm::vec3(252, 137, 97), glm::vec3(252, 253, 191)};

uint8_t to_byte(float value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

float exposure_for(const Reference& reference) {
    double light = 0.0;
    double weight = 0.0;
    for (size_t i = 0; i < reference.weight.size(); ++i) {
        const glm::vec3& c = reference.picture.pixels[i];
        light += static_cast<double>(reference.weight[i] * (c.x + c.y + c.z) / 3.0f);
        weight += static_cast<double>(reference.weight[i]);
    }
    if (light <= 0.0) return 1.0f;
    return std::min(static_cast<float>(kMiddle * weight / light), kMostExposure);
}

std::vector<glm::vec3> displayed(const Radiance& picture, float exposure) {
    std::vector<glm::vec3> shown;
    shown.reserve(picture.pixels.size());
    for (const glm::vec3& c : picture.pixels) {
        shown.push_back(exposure > 0.0f ? glsl::display_color(c, exposure)
                                        : glm::clamp(c, 0.0f, 1.0f));
    }
    return shown;
}

asset::Image to_image(const std::vector<glm::vec3>& shown, glm::uvec2 size) {
    asset::Image image{size.x, size.y, std::vector<uint8_t>(4 * shown.size(), 255)};
    for (size_t i = 0; i < shown.size(); ++i) {
        for (int c = 0; c < 3; ++c) image.rgba[4 * i + c] = to_byte(shown[i][c]);
    }
    return image;
}

asset::Image heat_map(std::span<const float> errors, glm::uvec2 size) {
    std::vector<glm::vec3> shown;
    shown.reserve(errors.size());
    for (const float error : errors) {
        const float at = std::clamp(error, 0.0f, 1.0f) * (kMagma.size() - 1);
        const auto low = std::min(static_cast<size_t>(at), kMagma.size() - 2);
        shown.push_back(glm::mix(kMagma[low], kMagma[low + 1], at - static_cast<float>(low)) /
                        255.0f);
    }
    return to_image(shown, size);
}

Result<std::vector<std::byte>> encode_jpeg(const asset::Image& image) {
    std::vector<std::byte> bytes;
    const auto append = [](void* context, void* data, int size) {
        auto& out = *static_cast<std::vector<std::byte>*>(context);
        const auto* first = static_cast<const std::byte*>(data);
        out.insert(out.end(), first, first + size);
    };
    if (stbi_write_jpg_to_func(append, &bytes, static_cast<int>(image.width),
                               static_cast<int>(image.height), 4, image.rgba.data(),
                               kJpegQuality) == 0) {
        return Error{"a picture could not be encoded", "JPEG", ""};
    }
    return bytes;
}

}  // namespace vellus::demo
