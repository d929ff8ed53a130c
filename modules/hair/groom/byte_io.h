#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace vellus::hair {

static_assert(std::endian::native == std::endian::little, "groom files are little-endian");

/// Whether `count` values of `size` bytes from `offset` lie inside a file of `total` bytes.
constexpr bool fits(uint64_t total, uint64_t offset, uint64_t count, uint64_t size) {
    return offset <= total && count <= (total - offset) / size;
}

/// Copies `count` values from `offset`; the caller has checked that they fit.
template <class T>
std::vector<T> copy_values(std::span<const std::byte> bytes, size_t offset, size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes.data() + offset, count * sizeof(T));
    return values;
}

template <class T>
T copy_value(std::span<const std::byte> bytes, size_t offset) {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

template <class T>
void append_values(std::vector<std::byte>& bytes, std::span<const T> values) {
    if (values.empty()) return;
    const size_t before = bytes.size();
    bytes.resize(before + values.size_bytes());
    std::memcpy(bytes.data() + before, values.data(), values.size_bytes());
}

template <class T>
void append_value(std::vector<std::byte>& bytes, const T& value) {
    append_values(bytes, std::span<const T>(&value, 1));
}

}  // namespace vellus::hair
