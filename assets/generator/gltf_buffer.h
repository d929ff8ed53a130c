#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace vellus::sculpt {

/// The one buffer of a glTF file while it is put together, with its views and accessors.
class GltfBuffer {
  public:
    enum Target { kNone = 0, kVertices = 34962, kIndices = 34963 };

    /// Appends values as one buffer view and one accessor; returns the accessor's index.
    /// `component` is glTF's number of T's component type, `type` e.g. "VEC3", which may be the
    /// first three of T's four 16-bit components.
    template <class T>
    size_t add(std::span<const T> values, int component, const char* type, Target target,
               bool normalized = false) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        nlohmann::ordered_json view = {
            {"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size_bytes()}};
        if (target != kNone) {
            view["target"] = static_cast<int>(target);
        }
        if (target == kVertices && std::string_view(type) == "VEC3" && sizeof(T) == 8) {
            view["byteStride"] = sizeof(T);
        }
        views_.push_back(std::move(view));
        const auto raw = std::as_bytes(values);
        bytes_.insert(bytes_.end(), raw.begin(), raw.end());
        nlohmann::ordered_json accessor = {{"bufferView", views_.size() - 1},
                                           {"componentType", component},
                                           {"count", values.size()},
                                           {"type", type}};
        if (normalized) {
            accessor["normalized"] = true;
        }
        accessors_.push_back(std::move(accessor));
        return accessors_.size() - 1;
    }

    /// The smallest and largest values, which glTF wants for positions and key times.
    void set_range(size_t accessor, std::vector<float> low, std::vector<float> high) {
        accessors_[accessor]["min"] = std::move(low);
        accessors_[accessor]["max"] = std::move(high);
    }

    [[nodiscard]] const nlohmann::ordered_json& views() const { return views_; }
    [[nodiscard]] const nlohmann::ordered_json& accessors() const { return accessors_; }
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
    std::vector<std::byte> bytes_;
};

}  // namespace vellus::sculpt
