#include <stb/stb_image_write.h>

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

void append(void* context, void* data, int size) {
    const auto* first = static_cast<const uint8_t*>(data);
    auto* seed = static_cast<vellus::fuzz::Bytes*>(context);
    seed->insert(seed->end(), first, first + size);
}

}  // namespace

std::vector<vellus::fuzz::Bytes> vellus::fuzz::fuzz_seeds() {
    const asset::Image image = small_image();
    Bytes jpeg;
    stbi_write_jpg_to_func(append, &jpeg, 5, 3, 4, image.rgba.data(), 60);
    return {to_seed(*asset::encode_png(image)), jpeg};
}
