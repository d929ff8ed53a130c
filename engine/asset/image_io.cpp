#include "engine/asset/image_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/asset/image_detail.h"
#include "engine/platform/files.h"
#include "engine/platform/log.h"

namespace vellus::asset {
namespace detail {

namespace {

bool starts_with(std::span<const std::byte> bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

}  // namespace

bool is_png(std::span<const std::byte> bytes) {
    return starts_with(bytes, "\x89PNG\r\n\x1a\n");
}
bool is_jpeg(std::span<const std::byte> bytes) {
    return starts_with(bytes, "\xff\xd8\xff");
}
bool is_exr(std::span<const std::byte> bytes) {
    return starts_with(bytes, "\x76\x2f\x31\x01");
}
bool is_hdr(std::span<const std::byte> bytes) {
    return starts_with(bytes, "#?");
}

std::optional<Error> check_size(uint64_t width, uint64_t height, uint64_t file_bytes,
                                uint64_t max_pixels) {
    if (width == 0 || height == 0) {
        return Error{fmt::format("an image of {}x{} pixels", width, height), "", "export it again"};
    }
    if (width > kMaxImageSide || height > kMaxImageSide || width * height > max_pixels) {
        return Error{fmt::format("an image of {}x{} pixels is over the limit", width, height), "",
                     fmt::format("scale it down: at most {} per side and {} in all", kMaxImageSide,
                                 max_pixels)};
    }
    if (width * height > kMaxPixelsPerByte * file_bytes) {
        return Error{fmt::format("{} bytes cannot hold {}x{} pixels", file_bytes, width, height),
                     "", "the file is cut off or its header is wrong: export it again"};
    }
    return std::nullopt;
}

void repair_pixels(ImageF& image) {
    constexpr float kLargestHalf = 65504.0f;
    for (float& value : image.rgba) {
        if (!std::isfinite(value)) {
            value = value > 0.0f ? kLargestHalf : 0.0f;
            ++image.repairs.not_finite;
        } else if (value < 0.0f) {
            value = 0.0f;
            ++image.repairs.negative;
        }
    }
}

}  // namespace detail

namespace {

/// sRGB (IEC 61966-2-1) to linear, for every 8-bit code.
std::array<float, 256> srgb_table() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const double encoded = static_cast<double>(i) / 255.0;
        table[i] = static_cast<float>(
            encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return table;
}

/// Reads `path` and decodes it; errors name the file.
template <class T, class Decode>
Result<T> load(const std::filesystem::path& path, Decode decode) {
    const auto bytes = read_file(path);
    if (!bytes) {
        return bytes.error();
    }
    Result<T> image = decode(std::span<const std::byte>(*bytes));
    if (!image) {
        return Error{image.error().what, path.string(), image.error().remedy};
    }
    return image;
}

Result<void> save(const std::filesystem::path& path, const Result<std::vector<std::byte>>& file) {
    if (!file) {
        return Error{file.error().what, path.string(), file.error().remedy};
    }
    return write_file(path, std::span<const std::byte>(*file));
}

}  // namespace

ImageF to_linear(const Image& image) {
    static const std::array<float, 256> kLinear = srgb_table();
    ImageF result{image.width, image.height, std::vector<float>(image.rgba.size()), {}};
    for (size_t i = 0; i < image.rgba.size(); ++i) {
        const uint8_t code = image.rgba[i];
        result.rgba[i] = i % 4 == 3 ? static_cast<float>(code) / 255.0f : kLinear[code];
    }
    return result;
}

Result<Image> load_image(const std::filesystem::path& path) {
    return load<Image>(path, [](std::span<const std::byte> bytes) { return decode_image(bytes); });
}

Result<ImageF> decode_image_f(std::span<const std::byte> bytes) {
    if (detail::is_exr(bytes)) {
        return decode_exr(bytes);
    }
    if (detail::is_hdr(bytes)) {
        return decode_hdr(bytes);
    }
    if (!detail::is_png(bytes) && !detail::is_jpeg(bytes)) {
        return Error{"no image of a known kind", "", "use .exr, .hdr, .png or .jpg"};
    }
    const Result<Image> image = decode_image(bytes);
    if (!image) {
        return image.error();
    }
    return to_linear(*image);
}

Result<ImageF> load_image_f(const std::filesystem::path& path) {
    Result<ImageF> image = load<ImageF>(path, decode_image_f);
    if (image && (image->repairs.not_finite > 0 || image->repairs.negative > 0)) {
        log_warning("{}: {} non-finite and {} negative values set to the nearest usable one",
                    path.string(), image->repairs.not_finite, image->repairs.negative);
    }
    return image;
}

Result<void> save_png(const std::filesystem::path& path, const Image& image) {
    return save(path, encode_png(image));
}

Result<void> save_exr(const std::filesystem::path& path, const ImageF& image) {
    return save(path, encode_exr(image));
}

Result<void> save_hdr(const std::filesystem::path& path, const ImageF& image) {
    return save(path, encode_hdr(image));
}

}  // namespace vellus::asset
