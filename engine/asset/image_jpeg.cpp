#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs FILE

#include <jpeglib.h>

#include "engine/asset/image_detail.h"

namespace vellus::asset::detail {
namespace {

/// Progressive files may repeat scans without end; cameras and encoders need about ten.
constexpr int kMaxScans = 100;

struct Decoder {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf on_error{};
    std::array<char, JMSG_LENGTH_MAX> message{};
};

[[noreturn]] void fail(j_common_ptr jpeg) {
    auto* decoder = static_cast<Decoder*>(jpeg->client_data);
    jpeg->err->format_message(jpeg, decoder->message.data());
    std::longjmp(decoder->on_error, 1);  // NOLINT: how libjpeg leaves on an error
}

void keep_quiet(j_common_ptr /*jpeg*/, int /*level*/) {}

void limit_scans(j_common_ptr jpeg) {
    auto* decoder = static_cast<Decoder*>(jpeg->client_data);
    if (decoder->jpeg.input_scan_number > kMaxScans) {
        std::snprintf(decoder->message.data(), decoder->message.size(), "more than %d scans",
                      kMaxScans);
        std::longjmp(decoder->on_error, 1);  // NOLINT
    }
}

/// Everything between set-up and destruction. longjmp may leave this function, so it owns nothing:
/// the pixels belong to the caller. False with a message in the decoder, or with `size_error` set.
bool decode(Decoder& decoder, std::span<const std::byte> bytes, uint64_t max_pixels, Image& image,
            std::optional<Error>& size_error) {
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    if (setjmp(decoder.on_error) != 0) {  // NOLINT
        return false;
    }
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg, TRUE);
    size_error = check_size(jpeg.image_width, jpeg.image_height, bytes.size(), max_pixels);
    if (size_error) {
        return false;
    }
    jpeg.out_color_space = JCS_EXT_RGBA;
    image.width = jpeg.image_width;
    image.height = jpeg.image_height;
    image.rgba.resize(size_t{4} * image.width * image.height);
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = image.rgba.data() + size_t{4} * image.width * jpeg.output_scanline;
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

}  // namespace

Result<Image> decode_jpeg(std::span<const std::byte> bytes, uint64_t max_pixels) {
    Decoder decoder;
    decoder.jpeg.err = jpeg_std_error(&decoder.errors);
    decoder.errors.error_exit = fail;
    decoder.errors.emit_message = keep_quiet;
    jpeg_create_decompress(&decoder.jpeg);
    decoder.jpeg.client_data = &decoder;
    decoder.progress.progress_monitor = limit_scans;
    decoder.jpeg.progress = &decoder.progress;
    Image image;
    std::optional<Error> size_error;
    const bool done = decode(decoder, bytes, max_pixels, image, size_error);
    jpeg_destroy_decompress(&decoder.jpeg);
    if (size_error) {
        return std::move(*size_error);
    }
    if (!done) {
        return Error{fmt::format("broken JPEG ({})", decoder.message.data()), "",
                     "export it again"};
    }
    return image;
}

}  // namespace vellus::asset::detail
