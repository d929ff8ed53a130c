#include <filesystem>
#include <fstream>
#include <string>

#include "tests/fuzz/fuzz.h"

// Fills the first corpus folder named on the command line with the seeds, where it is empty.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    namespace fs = std::filesystem;
    for (int i = 1; i < *argc; ++i) {
        const fs::path folder = (*argv)[i];
        if (folder.native().starts_with('-') || !fs::is_directory(folder)) {
            continue;
        }
        if (fs::is_empty(folder)) {
            size_t index = 0;
            for (const auto& seed : vellus::fuzz::all_seeds()) {
                std::ofstream out(folder / ("seed_" + std::to_string(index++)), std::ios::binary);
                out.write(reinterpret_cast<const char*>(seed.data()),
                          static_cast<std::streamsize>(seed.size()));
            }
        }
        break;
    }
    return 0;
}
