#include <stb_image.h>
#include <stb_image_write.h>

#include <memory>

#include "engine/asset/image_detail.h"

namespace vellus::asset {

namespace {

/// Signature, length and type of the first chunk, then width and height.
constexpr size_t kPngHeaderEnd = 24;

uint32_t big_endian(std::span<const std::byte, 4> bytes) {
    uint32_t value = 0;
    for (const std::byte b : bytes) {
        value = value << 8U | static_cast<uint32_t>(b);
    }
    return value;
}

void append(void* context, void* data, int size) {
    auto* file = static_cast<std::vector<std::byte>*>(context);
    const auto* first = static_cast<const std::byte*>(data);
    file->insert(file->end(), first, first + size);
}

}  // namespace

Result<Image> decode_image(std::span<const std::byte> bytes, uint64_t max_pixels) {
    if (detail::is_jpeg(bytes)) {
        return detail::decode_jpeg(bytes, max_pixels);
    }
    if (!detail::is_png(bytes)) {
        return Error{"neither PNG nor JPEG", "", "convert it to PNG"};
    }
    if (bytes.size() < kPngHeaderEnd || bytes.size() > std::numeric_limits<int>::max()) {
        return Error{fmt::format("a PNG of {} bytes", bytes.size()), "", "export it again"};
    }
    if (auto error =
            detail::check_size(big_endian(bytes.subspan<16, 4>()),
                               big_endian(bytes.subspan<20, 4>()), bytes.size(), max_pixels)) {
        return std::move(*error);
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                              static_cast<int>(bytes.size()), &width, &height, &channels, 4),
        stbi_image_free);
    if (!pixels) {
        return Error{fmt::format("broken PNG ({})", stbi_failure_reason()), "", "export it again"};
    }
    Image image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    image.rgba.assign(pixels.get(), pixels.get() + size_t{4} * image.width * image.height);
    return image;
}

Result<std::vector<std::byte>> encode_png(const Image& image) {
    assert(image.rgba.size() == size_t{4} * image.width * image.height);
    std::vector<std::byte> file;
    if (image.rgba.empty() ||
        stbi_write_png_to_func(append, &file, static_cast<int>(image.width),
                               static_cast<int>(image.height), 4, image.rgba.data(), 0) == 0) {
        return Error{fmt::format("cannot write a PNG of {}x{} pixels", image.width, image.height),
                     "", "use a size of at least 1x1 that fits into memory"};
    }
    return file;
}

Result<std::vector<std::byte>> encode_hdr(const ImageF& image) {
    assert(image.rgba.size() == size_t{4} * image.width * image.height);
    std::vector<std::byte> file;
    if (image.rgba.empty() ||
        stbi_write_hdr_to_func(append, &file, static_cast<int>(image.width),
                               static_cast<int>(image.height), 4, image.rgba.data()) == 0) {
        return Error{fmt::format("cannot write an HDR of {}x{} pixels", image.width, image.height),
                     "", "use a size of at least 1x1 that fits into memory"};
    }
    return file;
}

}  // namespace vellus::asset
