#include "engine/asset/image_io.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/image_seeds.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto image = vellus::asset::decode_hdr({reinterpret_cast<const std::byte*>(data), size});
    vellus::fuzz::require(image ? vellus::fuzz::usable(*image) : !image.error().remedy.empty());
    return 0;
}

std::vector<vellus::fuzz::Bytes> vellus::fuzz::fuzz_seeds() {
    const std::string old_coding =
        "#?RADIANCE\nFORMAT=32-bit_rle_xyze\nEXPOSURE=2\nCOLORCORR=1 2 3\n\n+X 2 -Y 300\n" +
        std::string("\x80\x40\x20\x81\x01\x01\x01\x2b\x01\x01\x01\x01", 12) +
        std::string("\x80\x40\x20\x81\x01\x01\x01\x2b\x01\x01\x01\x01", 12);
    return {to_seed(*asset::encode_hdr(small_image_f())),
            to_seed(std::as_bytes(std::span(old_coding)))};
}
