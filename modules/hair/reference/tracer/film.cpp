#include "modules/hair/reference/tracer/film.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "shaders/common/portable.h"

namespace vellus::hair::tracer {

namespace {

namespace glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/tonemap.glsl"
}  // namespace glsl

constexpr uint64_t kMagic = 0x3154504B4C4C4556u;  // "VELLKPT1"

struct Header {
    uint64_t magic = kMagic;
    uint64_t fingerprint = 0;
    uint32_t width = 0;
    uint32_t height = 0;
};

}  // namespace

Film::Film(const glm::uvec2& size) : size_(size), pixels_(size_t{size.x} * size.y) {}

uint32_t Film::complete() const {
    uint32_t least = pixels_.empty() ? 0 : ~0u;
    for (const Pixel& pixel : pixels_) least = std::min(least, pixel.count);
    return least;
}

void Film::add(size_t index, const PathSample& sample) {
    Pixel& pixel = pixels_[index];
    pixel.sum += sample.radiance;
    pixel.squares += sample.radiance * sample.radiance;
    ++pixel.count;
    pixel.covered += sample.covered ? 1 : 0;
    pixel.hair += sample.hair ? 1 : 0;
}

glm::dvec3 Film::mean(size_t index) const {
    const Pixel& pixel = pixels_[index];
    return pixel.sum / static_cast<double>(std::max(pixel.count, 1u));
}

glm::dvec3 Film::standard_error(size_t index) const {
    const Pixel& pixel = pixels_[index];
    if (pixel.count < 2) return glm::dvec3(0.0);
    const double n = pixel.count;
    const glm::dvec3 mean = pixel.sum / n;
    const glm::dvec3 variance = glm::max(pixel.squares / n - mean * mean, 0.0) * (n / (n - 1.0));
    return glm::sqrt(variance / n);
}

double Film::coverage(size_t index) const {
    return static_cast<double>(pixels_[index].covered) / std::max(pixels_[index].count, 1u);
}

double Film::hair(size_t index) const {
    return static_cast<double>(pixels_[index].hair) / std::max(pixels_[index].count, 1u);
}

asset::PlaneImage Film::planes() const {
    asset::PlaneImage image{size_.x, size_.y, {}};
    for (const char* name : {"R", "G", "B", "A", "error.R", "error.G", "error.B", "hair"}) {
        image.planes.push_back({name, std::vector<float>(pixels_.size())});
    }
    for (size_t i = 0; i < pixels_.size(); ++i) {
        const glm::dvec3 color = mean(i);
        const glm::dvec3 error = standard_error(i);
        for (int c = 0; c < 3; ++c) {
            image.planes[c].values[i] = static_cast<float>(color[c]);
            image.planes[4 + c].values[i] = static_cast<float>(error[c]);
        }
        image.planes[3].values[i] = static_cast<float>(coverage(i));
        image.planes[7].values[i] = static_cast<float>(hair(i));
    }
    return image;
}

asset::Image Film::display(float exposure) const {
    asset::Image image{size_.x, size_.y, std::vector<uint8_t>(4 * pixels_.size(), 255)};
    for (size_t i = 0; i < pixels_.size(); ++i) {
        const glm::vec3 shown = glsl::display_color(glm::vec3(mean(i)), exposure);
        for (int c = 0; c < 3; ++c) {
            image.rgba[4 * i + c] = static_cast<uint8_t>(std::lround(shown[c] * 255.0f));
        }
    }
    return image;
}

std::vector<std::byte> Film::checkpoint(uint64_t fingerprint) const {
    const Header header{.fingerprint = fingerprint, .width = size_.x, .height = size_.y};
    const auto data = std::as_bytes(std::span(pixels_));
    std::vector<std::byte> bytes(sizeof(header) + data.size());
    std::memcpy(bytes.data(), &header, sizeof(header));
    std::ranges::copy(data, bytes.begin() + sizeof(header));
    return bytes;
}

Result<Film> Film::from_checkpoint(std::span<const std::byte> bytes, uint64_t fingerprint) {
    Header header;
    const Error broken{"is no whole checkpoint", "", "delete it to start anew"};
    if (bytes.size() < sizeof(header)) return broken;
    std::memcpy(&header, bytes.data(), sizeof(header));
    const uint64_t pixels = uint64_t{header.width} * header.height;
    if (header.magic != kMagic || bytes.size() - sizeof(header) != pixels * sizeof(Pixel)) {
        return broken;
    }
    if (header.fingerprint != fingerprint) {
        return Error{"belongs to another scene, size, seed, depth or version", "",
                     "give the options it was begun with, or delete it to start anew"};
    }
    Film film({header.width, header.height});
    std::memcpy(film.pixels_.data(), bytes.data() + sizeof(header), pixels * sizeof(Pixel));
    return film;
}

}  // namespace vellus::hair::tracer
