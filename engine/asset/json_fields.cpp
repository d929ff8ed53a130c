#include "engine/asset/json_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vellus::asset {

using nlohmann::json;

JsonFields::JsonFields(const json& object, std::string where) : where_(std::move(where)) {
    if (object.is_object()) {
        object_ = &object;
    } else {
        error_ = Error{fmt::format("is {}, not an object", object.type_name()), where_,
                       "write it in { }"};
    }
}

bool JsonFields::has(std::string_view name) const {
    return object_ != nullptr && object_->contains(name);
}

const json* JsonFields::find(std::string_view name) {
    asked_.emplace_back(name);
    if (object_ == nullptr) return nullptr;
    const auto found = object_->find(name);
    return found == object_->end() ? nullptr : &*found;
}

void JsonFields::fail(std::string_view name, const std::string& what, const std::string& remedy) {
    if (error_) return;
    error_ = Error{what, fmt::format("{}.{}", where_, name), remedy};
}

void JsonFields::number(std::string_view name, double low, double high, double& value) {
    const json* field = find(name);
    if (field == nullptr) return;
    const std::string range = fmt::format("give a number from {} to {}", low, high);
    if (!field->is_number()) return fail(name, fmt::format("is {}", field->type_name()), range);
    const auto given = field->get<double>();
    if (!(given >= low && given <= high)) return fail(name, fmt::format("is {}", given), range);
    value = given;
}

void JsonFields::number(std::string_view name, double low, double high, float& value) {
    double wide = value;
    number(name, low, high, wide);
    value = static_cast<float>(wide);
}

void JsonFields::numbers(std::string_view name, double low, double high, std::span<double> values) {
    const json* field = find(name);
    if (field == nullptr) return;
    const std::string range =
        fmt::format("give {} numbers from {} to {}", values.size(), low, high);
    if (!field->is_array() || field->size() != values.size()) {
        return fail(name,
                    field->is_array() ? fmt::format("has {} values", field->size())
                                      : fmt::format("is {}", field->type_name()),
                    range);
    }
    for (const json& item : *field) {
        if (!item.is_number()) return fail(name, fmt::format("holds {}", item.type_name()), range);
        const auto given = item.get<double>();
        if (!(given >= low && given <= high)) {
            return fail(name, fmt::format("holds {}", given), range);
        }
    }
    std::ranges::transform(*field, values.begin(),
                           [](const json& item) { return item.get<double>(); });
}

void JsonFields::boolean(std::string_view name, bool& value) {
    const json* field = find(name);
    if (field == nullptr) return;
    if (!field->is_boolean()) {
        return fail(name, fmt::format("is {}", field->type_name()), "give true or false");
    }
    value = field->get<bool>();
}

void JsonFields::text(std::string_view name, std::string& value) {
    const json* field = find(name);
    if (field == nullptr) return;
    if (!field->is_string()) {
        return fail(name, fmt::format("is {}", field->type_name()), "give a string");
    }
    value = field->get<std::string>();
}

void JsonFields::index_or_text(std::string_view name, std::optional<uint32_t>& index,
                               std::string& value) {
    const json* field = find(name);
    if (field == nullptr) return;
    if (field->is_string()) {
        value = field->get<std::string>();
        return;
    }
    const bool whole = field->is_number_integer() && field->get<int64_t>() >= 0 &&
                       field->get<int64_t>() <= std::numeric_limits<uint32_t>::max();
    if (!whole) {
        const std::string given =
            field->is_number() ? field->dump() : std::string(field->type_name());
        return fail(name, fmt::format("is {}", given), "give a whole number from 0, or a name");
    }
    index = field->get<uint32_t>();
}

void JsonFields::choice(std::string_view name, std::span<const std::string_view> allowed,
                        std::string& value) {
    std::string given = value;
    text(name, given);
    if (given == value) return;
    if (std::ranges::find(allowed, given) == allowed.end()) {
        return fail(name, fmt::format("is '{}'", given),
                    fmt::format("choose one of: {}", fmt::join(allowed, ", ")));
    }
    value = given;
}

void JsonFields::adopt(JsonFields& inner) {
    if (!error_) error_ = inner.error_;
    const auto unknown = inner.unknown_fields();
    inner_unknown_.insert(inner_unknown_.end(), unknown.begin(), unknown.end());
}

std::vector<std::string> JsonFields::unknown_fields() const {
    std::vector<std::string> lines = inner_unknown_;
    if (object_ == nullptr) return lines;
    for (const auto& [name, value] : object_->items()) {
        if (name == "extras" || name == "extensions") continue;
        if (std::ranges::find(asked_, name) != asked_.end()) continue;
        lines.push_back(fmt::format("{}.{}: unknown field, ignored (known: {})", where_, name,
                                    fmt::join(asked_, ", ")));
    }
    return lines;
}

Result<json> parse_json(std::string_view text, const std::string& where) {
    try {
        return json::parse(text);
    } catch (const json::exception& exception) {
        return Error{fmt::format("is not JSON: {}", exception.what()), where, "correct the text"};
    }
}

}  // namespace vellus::asset
