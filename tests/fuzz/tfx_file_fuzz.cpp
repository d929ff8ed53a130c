#include "modules/hair/groom/groom_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/groom_check.h"

namespace vellus::fuzz {

namespace {

/// The smallest file of version 3: a header of 296 bytes and two strands of two points.
Bytes version_three() {
    Bytes bytes(296 + 48, 0);
    const auto put = [&](size_t offset, auto value) {
        std::memcpy(bytes.data() + offset, &value, sizeof(value));
    };
    put(0, 3.0f);
    put(4, 2U);
    put(8, 2U);
    put(144, 296U);
    for (size_t i = 0; i < 12; ++i) put(296 + 4 * i, static_cast<float>(i));
    return bytes;
}

}  // namespace

std::vector<Bytes> fuzz_seeds() {
    return {version_three(), to_bytes(hair::write_tfx(sample_groom(false, false))),
            to_bytes(hair::write_tfx(sample_groom(false, true)))};
}

}  // namespace vellus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    vellus::fuzz::check_groom(vellus::hair::read_tfx(bytes, "fuzz"), vellus::hair::write_tfx,
                              vellus::hair::read_tfx);
    return 0;
}
