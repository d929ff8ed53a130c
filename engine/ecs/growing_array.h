#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "engine/ecs/memory.h"

namespace vellus {

/// An array of trivial objects that grows without copying (see resize_memory) or zeroing.
template <class T>
class GrowingArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    GrowingArray() = default;
    ~GrowingArray() { resize_memory(data_, capacity_ * sizeof(T), 0); }
    GrowingArray(const GrowingArray&) = delete;
    GrowingArray& operator=(const GrowingArray&) = delete;

    [[nodiscard]] size_t size() const noexcept { return size_; }
    T& operator[](size_t index) noexcept { return data_[index]; }
    const T& operator[](size_t index) const noexcept { return data_[index]; }

    /// Adds objects, not initialised, and returns the first one's index.
    size_t append(size_t count) {
        if (count > capacity_ - size_) grow(size_ + count);
        const size_t first = size_;
        size_ += count;
        return first;
    }

  private:
    void grow(size_t size) {
        const size_t capacity = std::max(size, capacity_ * 2);
        data_ = static_cast<T*>(resize_memory(data_, capacity_ * sizeof(T), capacity * sizeof(T)));
        capacity_ = capacity;
    }

    T* data_ = nullptr;
    size_t size_ = 0;
    size_t capacity_ = 0;
};

}  // namespace vellus
