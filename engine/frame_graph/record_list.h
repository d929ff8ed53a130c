#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace vellus::graph {

/// A growing array of plain records that is filled anew every frame: append() constructs in place
/// and zeroes nothing first, the size is at hand, clear() keeps the memory.
template <class T>
class RecordList {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    /// The new record, default-initialised. Others may move.
    T& append() {
        if (size_ == capacity_) [[unlikely]]
            grow();
        return *new (at(size_++)) T;
    }
    /// The record becomes the one at `index`; those from there on move up.
    T& insert(uint32_t index) {
        append();
        std::memmove(at(index + 1), at(index), (size_ - 1 - index) * sizeof(T));
        return *new (at(index)) T;
    }
    void clear() { size_ = 0; }

    [[nodiscard]] uint32_t size() const { return size_; }
    T& operator[](uint32_t index) { return *at(index); }
    const T& operator[](uint32_t index) const { return *at(index); }
    T& back() { return *at(size_ - 1); }
    [[nodiscard]] std::span<const T> span() const { return {at(0), size_}; }

  private:
    [[nodiscard]] T* at(uint32_t index) const {
        return std::launder(reinterpret_cast<T*>(memory_.get())) + index;
    }
    void grow() {
        const uint32_t capacity = std::max(16U, capacity_ * 2);
        auto memory = std::make_unique_for_overwrite<std::byte[]>(capacity * sizeof(T));
        if (size_ != 0) std::memcpy(memory.get(), memory_.get(), size_ * sizeof(T));
        memory_ = std::move(memory);
        capacity_ = capacity;
    }

    std::unique_ptr<std::byte[]> memory_;
    uint32_t size_ = 0;
    uint32_t capacity_ = 0;
};

}  // namespace vellus::graph
