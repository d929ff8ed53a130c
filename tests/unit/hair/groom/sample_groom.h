#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <random>
#include <span>
#include <vector>

#include "modules/hair/groom/groom.h"

namespace vellus::hair::test {

/// Appends the raw bytes of values: the tests build files by hand, not with the code under test.
template <class T>
void put(std::vector<std::byte>& bytes, std::initializer_list<T> values) {
    for (const T& value : values) {
        std::byte raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        bytes.insert(bytes.end(), raw, raw + sizeof(T));
    }
}

template <class T>
void overwrite(std::vector<std::byte>& bytes, size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

/// Strands of random points with the point counts given; no optional columns.
inline Groom random_groom(const std::vector<uint32_t>& counts, uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-10.0f, 10.0f);
    Groom groom;
    for (const uint32_t count : counts) {
        for (uint32_t i = 0; i < count; ++i) {
            groom.points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return groom;
}

/// A different value in [0, 1) for each index.
inline float fraction(size_t index) {
    return static_cast<float>((index * 37) % 101) / 101.0f;
}

inline std::filesystem::path data_file(const char* name) {
    return std::filesystem::path(VELLUS_TEST_DATA) / "hair" / name;
}

}  // namespace vellus::hair::test
