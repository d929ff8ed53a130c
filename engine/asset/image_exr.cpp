#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>

#include <cstring>
#include <mutex>

#include "engine/asset/exr_streams.h"
#include "engine/asset/image_detail.h"

namespace vellus::asset {
namespace {

using detail::MemoryReader;
using detail::MemoryWriter;

/// The channel that starts at `base` of rows beginning at `origin`, in interleaved RGBA floats.
Imf::Slice float_slice(const float* base, const Imath::V2i& origin, uint32_t width, uint32_t height,
                       double fill) {
    constexpr size_t kPixel = 4 * sizeof(float);
    return Imf::Slice::Make(Imf::FLOAT, base, origin, width, height, kPixel, kPixel * width, 1, 1,
                            fill);
}

/// Luminance and chroma (Y with RY and BY) are subsampled and need OpenEXR's own conversion to RGB.
void read_chroma(MemoryReader& stream, const Imath::Box2i& window, ImageF& image) {
    stream.seekg(0);
    Imf::RgbaInputFile file(stream);
    std::vector<Imf::Rgba> pixels(size_t{image.width} * image.height);
    image.rgba.resize(4 * pixels.size());
    // OpenEXR wants the address of pixel (0, 0), which may lie outside the array: integer
    // arithmetic keeps it defined.
    const int64_t origin = window.min.x + int64_t{window.min.y} * image.width;
    const uintptr_t base = reinterpret_cast<uintptr_t>(pixels.data()) -
                           static_cast<uintptr_t>(origin) * sizeof(Imf::Rgba);
    file.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(base), 1, image.width);
    file.readPixels(window.min.y, window.max.y);
    for (size_t i = 0; i < pixels.size(); ++i) {
        const Imf::Rgba& p = pixels[i];
        const std::array<float, 4> rgba = {p.r, p.g, p.b, p.a};
        std::copy(rgba.begin(), rgba.end(),
                  image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
    }
}

/// Of the R, G, B and A channels, or of Y and A with the middle two empty.
using ChannelNames = std::array<std::string, 4>;

/// Plain R, G, B, A; else Y; else those of the first layer that has them ("beauty.R").
ChannelNames choose_channels(const Imf::ChannelList& channels) {
    if (channels.findChannel("R") != nullptr) {
        return {"R", "G", "B", "A"};
    }
    if (channels.findChannel("Y") != nullptr) {
        return {"Y", "", "", "A"};
    }
    std::set<std::string> layers;
    channels.layers(layers);
    for (const std::string& layer : layers) {
        if (channels.findChannel(layer + ".R") != nullptr) {
            return {layer + ".R", layer + ".G", layer + ".B", layer + ".A"};
        }
    }
    throw std::runtime_error("no channels named R, G, B or Y");
}

/// Reads some rows at a time, so that a header that lies about the size ends in an error before it
/// costs memory.
void read_channels(Imf::InputPart& file, const Imath::Box2i& window, ImageF& image) {
    constexpr int kRows = 256;  // the most lines any compression packs together
    const ChannelNames names = choose_channels(file.header().channels());
    for (int y = window.min.y; y <= window.max.y; y += kRows) {
        const int last = std::min(y + kRows - 1, window.max.y);
        const uint32_t rows = static_cast<uint32_t>(last - y + 1);
        const size_t start = image.rgba.size();
        image.rgba.resize(start + size_t{4} * image.width * rows);
        Imf::FrameBuffer frame;
        for (size_t i = 0; i < 4; ++i) {
            if (!names[i].empty()) {
                frame.insert(names[i], float_slice(image.rgba.data() + start + i, {window.min.x, y},
                                                   image.width, rows, i == 3 ? 1.0 : 0.0));
            }
        }
        file.setFrameBuffer(frame);
        file.readPixels(y, last);
    }
    for (size_t i = 0; names[1].empty() && i < image.rgba.size(); i += 4) {
        image.rgba[i + 1] = image.rgba[i + 2] = image.rgba[i];
    }
}

Result<ImageF> read_exr(std::span<const std::byte> bytes) {
    MemoryReader stream(bytes);
    // This class only reads headers: the size can be judged before anything is allocated for it.
    Imf::MultiPartInputFile file(stream);
    const Imath::Box2i window = file.header(0).dataWindow();
    const uint64_t width = static_cast<uint64_t>(int64_t{window.max.x} - window.min.x + 1);
    const uint64_t height = static_cast<uint64_t>(int64_t{window.max.y} - window.min.y + 1);
    if (auto error = detail::check_size(width, height, bytes.size())) {
        return std::move(*error);
    }
    ImageF image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}, {}};
    const Imf::ChannelList& channels = file.header(0).channels();
    if (channels.findChannel("RY") != nullptr || channels.findChannel("BY") != nullptr) {
        read_chroma(stream, window, image);
    } else {
        Imf::InputPart part(file, 0);
        read_channels(part, window, image);
    }
    detail::repair_pixels(image);
    return image;
}

}  // namespace

Result<ImageF> decode_exr(std::span<const std::byte> bytes) {
    static std::once_flag limits;
    std::call_once(limits, [] {
        Imf::Header::setMaxImageSize(kMaxImageSide, kMaxImageSide);
        Imf::Header::setMaxTileSize(4096, 4096);
    });
    if (!detail::is_exr(bytes)) {
        return Error{"no OpenEXR file", "", "convert it to .exr"};
    }
    try {
        return read_exr(bytes);
    } catch (const std::exception& e) {
        return Error{fmt::format("broken or unsupported OpenEXR file: {}", e.what()), "",
                     "export it again as RGB, scanline or tiled"};
    }
}

Result<std::vector<std::byte>> encode_exr(const ImageF& image) {
    assert(image.rgba.size() == size_t{4} * image.width * image.height);
    try {
        Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::FrameBuffer frame;
        size_t offset = 0;
        for (const char* name : {"R", "G", "B", "A"}) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, float_slice(image.rgba.data() + offset++, {0, 0}, image.width,
                                           image.height, 0.0));
        }
        MemoryWriter stream;
        {
            Imf::OutputFile file(stream, header);
            file.setFrameBuffer(frame);
            file.writePixels(static_cast<int>(image.height));
        }
        return std::move(stream.bytes);
    } catch (const std::exception& e) {
        return Error{fmt::format("cannot write an EXR of {}x{} pixels: {}", image.width,
                                 image.height, e.what()),
                     "", "use a size of at least 1x1"};
    }
}

}  // namespace vellus::asset
