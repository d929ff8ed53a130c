#include "engine/asset/image_planes.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <cassert>

#include "engine/asset/exr_streams.h"
#include "engine/asset/image_detail.h"
#include "engine/platform/files.h"

namespace vellus::asset {
namespace {

Imf::Slice plane_slice(float* values, const Imath::V2i& origin, uint32_t width, uint32_t height) {
    return Imf::Slice::Make(Imf::FLOAT, values, origin, width, height, sizeof(float),
                            sizeof(float) * width);
}

std::vector<std::byte> encode(const PlaneImage& image) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (const Plane& plane : image.planes) {
        assert(plane.values.size() == size_t{image.width} * image.height);
        header.channels().insert(plane.name, Imf::Channel(Imf::FLOAT));
        // OpenEXR's slices are for reading and writing alike; here it only reads.
        frame.insert(plane.name, plane_slice(const_cast<float*>(plane.values.data()), {0, 0},
                                             image.width, image.height));
    }
    detail::MemoryWriter stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writePixels(static_cast<int>(image.height));
    }
    return std::move(stream.bytes);
}

Result<PlaneImage> decode(std::span<const std::byte> bytes) {
    detail::MemoryReader stream(bytes);
    Imf::InputFile file(stream);
    const Imath::Box2i window = file.header().dataWindow();
    const auto width = static_cast<uint64_t>(int64_t{window.max.x} - window.min.x + 1);
    const auto height = static_cast<uint64_t>(int64_t{window.max.y} - window.min.y + 1);
    if (auto error = detail::check_size(width, height, bytes.size())) return std::move(*error);
    PlaneImage image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    const Imf::ChannelList& channels = file.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) continue;
        image.planes.push_back({channel.name(), std::vector<float>(width * height)});
    }
    Imf::FrameBuffer frame;
    for (Plane& plane : image.planes) {
        frame.insert(plane.name,
                     plane_slice(plane.values.data(), window.min, image.width, image.height));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
}

}  // namespace

const Plane* PlaneImage::find(const std::string& name) const {
    for (const Plane& plane : planes) {
        if (plane.name == name) return &plane;
    }
    return nullptr;
}

Result<void> save_planes(const std::filesystem::path& path, const PlaneImage& image) {
    try {
        const std::vector<std::byte> bytes = encode(image);
        return write_file(path, std::span<const std::byte>(bytes));
    } catch (const std::exception& e) {
        return Error{fmt::format("cannot be written as an EXR of {}x{} pixels: {}", image.width,
                                 image.height, e.what()),
                     path.string(), "use a size of at least 1x1"};
    }
}

Result<PlaneImage> load_planes(const std::filesystem::path& path) {
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    try {
        auto image = detail::is_exr(*bytes)
                         ? decode(*bytes)
                         : Result<PlaneImage>(Error{"no OpenEXR file", "", "convert it to .exr"});
        if (!image) return Error{image.error().what, path.string(), image.error().remedy};
        return image;
    } catch (const std::exception& e) {
        return Error{fmt::format("broken or unsupported OpenEXR file: {}", e.what()), path.string(),
                     "export it again"};
    }
}

}  // namespace vellus::asset
