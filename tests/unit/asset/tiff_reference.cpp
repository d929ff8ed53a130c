#include "tests/unit/asset/tiff_reference.h"

#include <stb/stb_image.h>

#include <cstring>
#include <map>

#include "engine/platform/files.h"

namespace vellus::asset::test {
namespace {

constexpr uint16_t kWidth = 256;
constexpr uint16_t kHeight = 257;
constexpr uint16_t kCompression = 259;
constexpr uint16_t kStripOffsets = 273;
constexpr uint16_t kStripBytes = 279;
constexpr uint16_t kPredictor = 317;

using Bytes = std::vector<std::byte>;

template <class T>
T get(const Bytes& file, size_t offset) {
    T value{};
    std::memcpy(&value, &file.at(offset), sizeof(T));
    return value;
}

/// All values of every tag that is made of SHORTs or LONGs.
std::map<uint16_t, std::vector<uint32_t>> read_tags(const Bytes& file) {
    std::map<uint16_t, std::vector<uint32_t>> tags;
    const size_t directory = get<uint32_t>(file, 4);
    for (size_t i = 0; i < get<uint16_t>(file, directory); ++i) {
        const size_t entry = directory + 2 + 12 * i;
        const uint16_t type = get<uint16_t>(file, entry + 2);
        const size_t count = get<uint32_t>(file, entry + 4);
        if (type != 3 && type != 4) {
            continue;
        }
        const size_t size = type == 3 ? 2 : 4;
        const size_t at = count * size > 4 ? get<uint32_t>(file, entry + 8) : entry + 8;
        for (size_t k = 0; k < count; ++k) {
            tags[get<uint16_t>(file, entry)].push_back(type == 3 ? get<uint16_t>(file, at + 2 * k)
                                                                 : get<uint32_t>(file, at + 4 * k));
        }
    }
    return tags;
}

/// TIFF Technical Note 3: byte planes, most significant first, differences of bytes three apart.
void undo_predictor(uint8_t* row, size_t values, float* out) {
    for (size_t i = 3; i < 4 * values; ++i) {
        row[i] = static_cast<uint8_t>(row[i] + row[i - 3]);
    }
    for (size_t i = 0; i < values; ++i) {
        const uint32_t bits = uint32_t{row[i]} << 24U | uint32_t{row[values + i]} << 16U |
                              uint32_t{row[2 * values + i]} << 8U | row[3 * values + i];
        std::memcpy(out + i, &bits, 4);
    }
}

}  // namespace

TiffImage read_float_tiff(const std::filesystem::path& path) {
    const auto file = read_file(path);
    if (!file) {
        return {};
    }
    const auto tags = read_tags(*file);
    if (tags.at(kCompression) != std::vector<uint32_t>{8} ||
        tags.at(kPredictor) != std::vector<uint32_t>{3}) {
        return {};
    }
    TiffImage image{tags.at(kWidth).at(0), tags.at(kHeight).at(0), {}};
    image.rgb.resize(size_t{3} * image.width * image.height);
    const size_t values = size_t{3} * image.width;
    size_t y = 0;
    for (size_t strip = 0; strip < tags.at(kStripOffsets).size(); ++strip) {
        const auto* data =
            reinterpret_cast<const char*>(file->data()) + tags.at(kStripOffsets)[strip];
        int size = 0;
        char* plain =
            stbi_zlib_decode_malloc(data, static_cast<int>(tags.at(kStripBytes)[strip]), &size);
        for (size_t at = 0; at + 4 * values <= static_cast<size_t>(size) && y < image.height;
             at += 4 * values) {
            undo_predictor(reinterpret_cast<uint8_t*>(plain) + at, values,
                           image.rgb.data() + values * y++);
        }
        stbi_image_free(plain);
    }
    return image;
}

}  // namespace vellus::asset::test
