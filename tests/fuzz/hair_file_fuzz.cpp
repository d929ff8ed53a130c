#include "modules/hair/groom/groom_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/groom_check.h"

namespace vellus::fuzz {

std::vector<Bytes> fuzz_seeds() {
    std::vector<Bytes> seeds;
    for (const bool varied : {false, true}) {
        for (const bool columns : {false, true}) {
            seeds.push_back(to_bytes(hair::write_hair(sample_groom(varied, columns))));
        }
    }
    return seeds;
}

}  // namespace vellus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    vellus::fuzz::check_groom(vellus::hair::read_hair(bytes, "fuzz"), vellus::hair::write_hair,
                              vellus::hair::read_hair);
    return 0;
}
