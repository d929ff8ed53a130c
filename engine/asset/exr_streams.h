#pragma once

#include <ImfIO.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

// Shared by the EXR readers and writers only.
namespace vellus::asset::detail {

/// OpenEXR reads from the caller's bytes; running past their end throws, as the library asks for.
class MemoryReader : public Imf::IStream {
  public:
    explicit MemoryReader(std::span<const std::byte> bytes)
        : Imf::IStream("memory"), bytes_(bytes) {}

    bool read(char* to, int count) override {
        if (count < 0 || static_cast<uint64_t>(count) > bytes_.size() - position_) {
            throw std::runtime_error("the file ends too early");
        }
        std::memcpy(to, bytes_.data() + position_, static_cast<size_t>(count));
        position_ += static_cast<uint64_t>(count);
        return position_ < bytes_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override {
        if (position > bytes_.size()) {
            throw std::runtime_error("the file ends too early");
        }
        position_ = position;
    }
    void clear() override {}

  private:
    std::span<const std::byte> bytes_;
    uint64_t position_ = 0;
};

class MemoryWriter : public Imf::OStream {
  public:
    MemoryWriter() : Imf::OStream("memory") {}

    void write(const char* from, int count) override {
        const size_t size = static_cast<size_t>(count);
        bytes.resize(std::max(bytes.size(), position_ + size));
        std::memcpy(bytes.data() + position_, from, size);
        position_ += size;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

    std::vector<std::byte> bytes;

  private:
    size_t position_ = 0;
};

}  // namespace vellus::asset::detail
