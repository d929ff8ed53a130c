#include <algorithm>
#include <filesystem>

#include "engine/platform/files.h"
#include "tests/fuzz/fuzz.h"

namespace vellus::fuzz {

std::vector<Bytes> all_seeds() {
    std::vector<Bytes> seeds = fuzz_seeds();
    std::vector<std::filesystem::path> files;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(VELLUS_FUZZ_SEEDS, none)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        if (const auto bytes = read_file(file)) {
            const auto* first = reinterpret_cast<const uint8_t*>(bytes->data());
            seeds.emplace_back(first, first + bytes->size());
        }
    }
    return seeds;
}

}  // namespace vellus::fuzz
