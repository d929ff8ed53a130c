#include <array>
#include <cstdio>  // jpeglib.h needs FILE
#include <cstdlib>

#include <jpeglib.h>

#include "engine/asset/image_io.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/image_seeds.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto image =
        vellus::asset::decode_image({reinterpret_cast<const std::byte*>(data), size});
    vellus::fuzz::require(image ? image->rgba.size() == size_t{4} * image->width * image->height
                                : !image.error().remedy.empty());
    return 0;
}

namespace {

/// A JPEG with subsampled colour, baseline or progressive.
vellus::fuzz::Bytes small_jpeg(bool progressive) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* file = nullptr;
    unsigned long size = 0;  // NOLINT(google-runtime-int): libjpeg's type
    jpeg_mem_dest(&jpeg, &file, &size);
    jpeg.image_width = 18;
    jpeg.image_height = 10;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    if (progressive) {
        jpeg_simple_progression(&jpeg);
    }
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        std::array<JSAMPLE, 54> pixels{};
        for (size_t i = 0; i < pixels.size(); ++i) {
            pixels[i] = static_cast<JSAMPLE>(i * (7 + jpeg.next_scanline));
        }
        JSAMPROW row = pixels.data();
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    vellus::fuzz::Bytes bytes(file, file + size);
    std::free(file);  // NOLINT(cppcoreguidelines-no-malloc): libjpeg allocated it
    return bytes;
}

}  // namespace

std::vector<vellus::fuzz::Bytes> vellus::fuzz::fuzz_seeds() {
    return {to_seed(*asset::encode_png(small_image())), small_jpeg(false), small_jpeg(true)};
}
