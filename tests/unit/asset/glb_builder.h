#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace vellus::asset::test {

using Bytes = std::vector<std::byte>;

/// Collects binary data for a GLB: each piece becomes a buffer view, aligned to four bytes.
class GlbBuilder {
  public:
    /// Appends values as one buffer view (with `stride` in the JSON where not 0) and returns its
    /// index.
    template <class T>
    size_t view(const std::vector<T>& values, size_t stride = 0) {
        const size_t offset = bin_.size();
        bin_.resize(offset + values.size() * sizeof(T));
        std::memcpy(bin_.data() + offset, values.data(), values.size() * sizeof(T));
        views_ += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}{}}})",
                              views_.empty() ? "" : ",", offset, values.size() * sizeof(T),
                              stride != 0 ? fmt::format(R"(,"byteStride":{})", stride) : "");
        bin_.resize((bin_.size() + 3) / 4 * 4);
        return count_++;
    }

    /// The file: `json` is the inside of the root object after asset, buffers and bufferViews.
    [[nodiscard]] Bytes glb(const std::string& json) const {
        std::string text = fmt::format(
            R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],"bufferViews":[{}],{}}})",
            bin_.size(), views_, json);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto json_bytes = static_cast<uint32_t>(text.size());
        const auto bin_bytes = static_cast<uint32_t>(bin_.size());
        const std::array<uint32_t, 5> head = {0x46546C67, 2, 28 + json_bytes + bin_bytes,
                                              json_bytes, 0x4E4F534A};
        const std::array<uint32_t, 2> middle = {bin_bytes, 0x004E4942};
        Bytes file(head[2]);
        std::memcpy(file.data(), head.data(), 20);
        std::memcpy(file.data() + 20, text.data(), json_bytes);
        std::memcpy(file.data() + 20 + json_bytes, middle.data(), 8);
        std::memcpy(file.data() + 28 + json_bytes, bin_.data(), bin_bytes);
        return file;
    }

  private:
    Bytes bin_;
    std::string views_;
    size_t count_ = 0;
};

/// A .gltf text as bytes.
inline std::span<const std::byte> as_file(const std::string& json) {
    return std::as_bytes(std::span(json));
}

}  // namespace vellus::asset::test
