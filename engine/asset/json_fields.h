#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/platform/result.h"

namespace vellus::asset {

/// Reads the fields of one JSON object, each optional, each checked; remembers the first thing that
/// is wrong and which fields nobody asked for. An absent field leaves its value untouched.
class JsonFields {
  public:
    /// `where` names file and object in messages, e.g. "scene.gltf, node 'head', VELLUS_hair".
    JsonFields(const nlohmann::json& object, std::string where);

    [[nodiscard]] bool has(std::string_view name) const;

    void number(std::string_view name, double low, double high, double& value);
    void number(std::string_view name, double low, double high, float& value);
    /// An array of exactly values.size() numbers.
    void numbers(std::string_view name, double low, double high, std::span<double> values);
    void boolean(std::string_view name, bool& value);
    void text(std::string_view name, std::string& value);
    /// A whole number from 0 or a string, as the file has it.
    void index_or_text(std::string_view name, std::optional<uint32_t>& index, std::string& value);
    /// A string that must be one of `allowed`.
    void choice(std::string_view name, std::span<const std::string_view> allowed,
                std::string& value);
    /// Calls `read(JsonFields&)` on the object in field `name`; its errors and unknown fields are
    /// ours.
    template <class Read>
    void object(std::string_view name, const Read& read) {
        const nlohmann::json* field = find(name);
        if (field == nullptr) return;
        JsonFields inner(*field, where_ + "." + std::string(name));
        read(inner);
        adopt(inner);
    }

    /// Reports an error of the caller's own, about field `name`.
    void fail(std::string_view name, const std::string& what, const std::string& remedy);

    [[nodiscard]] const std::optional<Error>& error() const { return error_; }
    /// One line per field that was not asked for; "extras" and "extensions" are everybody's.
    [[nodiscard]] std::vector<std::string> unknown_fields() const;

  private:
    const nlohmann::json* find(std::string_view name);
    void adopt(JsonFields& inner);

    const nlohmann::json* object_ = nullptr;
    std::string where_;
    std::vector<std::string> asked_;
    std::vector<std::string> inner_unknown_;
    std::optional<Error> error_;
};

/// The parsed text, or an Error with the position of what is not JSON.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& where);

}  // namespace vellus::asset
