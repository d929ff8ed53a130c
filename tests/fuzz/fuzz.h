#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// A fuzz target NAME_fuzz.cpp defines LLVMFuzzerTestOneInput and fuzz_seeds; everything else is
// shared. Valid inputs to start from may also lie as files in seeds/NAME/.

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace vellus::fuzz {

using Bytes = std::vector<uint8_t>;

/// Small valid inputs made by code; each target defines its own.
std::vector<Bytes> fuzz_seeds();

/// fuzz_seeds() and the files of seeds/NAME/, in name order.
std::vector<Bytes> all_seeds();

}  // namespace vellus::fuzz
