#include <algorithm>
#include <cmath>
#include <set>

#include "engine/asset/gltf_context.h"
#include "engine/asset/gltf_properties.h"

namespace vellus::asset::detail {
namespace {

constexpr const char* kFixFile = "correct the file, or export it again";

/// What an object costs at most as JSON, in tinygltf and in the scene, its arrays apart.
constexpr uint64_t kObjectBytes = 2048;

const std::vector<const Property*>& properties_of(std::string_view owner) {
    static const auto kByOwner = [] {
        std::map<std::string_view, std::vector<const Property*>> map;
        for (const Property& property : kProperties) {
            map[property.owner].push_back(&property);
        }
        return map;
    }();
    static const std::vector<const Property*> kNone;
    const auto found = kByOwner.find(owner);
    return found == kByOwner.end() ? kNone : found->second;
}

class SchemaCheck {
  public:
    explicit SchemaCheck(Json& doc, Context& context) : doc_(doc), context_(context) {}

    void object(std::string_view type, Json& value, const std::string& pointer) {
        context_.charge(1, kObjectBytes, pointer);
        for (const Property* property : properties_of(type)) {
            const std::string place = fmt::format("{}/{}", pointer, property->name);
            const auto found = value.find(property->name);
            if (found != value.end()) {
                check(*property, *found, place);
            } else if (property->need == kRequired) {
                refuse(place, "required, but missing", kFixFile);
            }
        }
        const auto name = value.find("name");
        if (name != value.end() && !name->is_string() && !type.ends_with("Extensions")) {
            refuse(pointer + "/name", "no string", kFixFile);
        }
        extensions(value, pointer);
    }

    /// Names of all extension objects met so far.
    [[nodiscard]] const std::set<std::string>& extensions_used() const { return used_; }

  private:
    void extensions(const Json& value, const std::string& pointer) {
        const auto found = value.find("extensions");
        if (found == value.end()) {
            return;
        }
        if (!found->is_object()) {
            refuse(pointer + "/extensions", "no object", kFixFile);
        }
        for (const auto& [name, extension] : found->items()) {
            if (!extension.is_object()) {
                refuse(fmt::format("{}/extensions/{}", pointer, name), "no object", kFixFile);
            }
            used_.insert(name);
        }
    }

    void check(const Property& property, Json& value, const std::string& pointer) {
        if (property.shape == Shape::kOne) {
            check_one(property, value, pointer);
            return;
        }
        if (!value.is_array()) {
            refuse(pointer, "no array", kFixFile);
        }
        if (property.length != 0 && value.size() != property.length) {
            refuse(pointer, fmt::format("{} numbers instead of {}", value.size(), property.length),
                   kFixFile);
        }
        if (value.empty()) {
            context_.warn(pointer, "empty array");
        }
        for (size_t i = 0; i < value.size(); ++i) {
            check_one(property, value[i], fmt::format("{}/{}", pointer, i));
        }
    }

    void check_one(const Property& property, Json& value, const std::string& pointer) {
        switch (property.kind) {
            case Kind::kBoolean:
                require(value.is_boolean(), pointer, "no boolean");
                break;
            case Kind::kString:
                require(value.is_string(), pointer, "no string");
                break;
            case Kind::kInteger:
                integer(value, pointer);
                number(property, value, pointer);
                break;
            case Kind::kNumber:
                require(value.is_number(), pointer, "no number");
                number(property, value, pointer);
                break;
            case Kind::kObject:
                require(value.is_object(), pointer, "no object");
                object(property.target, value, pointer);
                break;
            case Kind::kIndex:
                index(property, value, pointer);
                break;
            case Kind::kIndexMap:
                require(value.is_object(), pointer, "no object");
                if (value.empty()) {
                    context_.warn(pointer, "empty object");
                }
                for (auto& [name, entry] : value.items()) {
                    index(property, entry, fmt::format("{}/{}", pointer, name));
                }
                break;
        }
    }

    static void require(bool condition, const std::string& pointer, const char* what) {
        if (!condition) {
            refuse(pointer, what, kFixFile);
        }
    }

    /// JSON knows no integers: 3.0 is as good as 3.
    static void integer(Json& value, const std::string& pointer) {
        require(value.is_number(), pointer, "no integer");
        if (value.is_number_float()) {
            const double number = value.get<double>();
            require(std::abs(number) <= kExactMax && number == std::floor(number), pointer,
                    "no integer");
            value = static_cast<int64_t>(number);
        }
    }

    void number(const Property& property, Json& value, const std::string& pointer) {
        const double number = value.get<double>();
        if (number >= property.min && number <= property.max) {
            return;
        }
        if (!property.clamp) {
            refuse(pointer, fmt::format("{} is out of range", number), kFixFile);
        }
        value = std::clamp(number, property.min, property.max);
        context_.warn(pointer, fmt::format("{} clamped to {}", number, value.get<double>()));
    }

    void index(const Property& property, Json& value, const std::string& pointer) {
        integer(value, pointer);
        const double number = value.get<double>();
        const size_t size = collection_size(property.target);
        if (number < 0 || number >= static_cast<double>(size)) {
            refuse(pointer, fmt::format("{} is none of the {} {}", number, size, property.target),
                   kFixFile);
        }
    }

    [[nodiscard]] size_t collection_size(std::string_view collection) const {
        static const Json::json_pointer kLights("/extensions/KHR_lights_punctual/lights");
        if (collection == "lights") {
            return doc_.contains(kLights) && doc_[kLights].is_array() ? doc_[kLights].size() : 0;
        }
        const auto found = doc_.find(collection);
        return found != doc_.end() && found->is_array() ? found->size() : 0;
    }

    Json& doc_;
    Context& context_;
    std::set<std::string> used_;
};

/// MAJOR.MINOR in decimal; nothing for anything else.
std::optional<std::pair<int, int>> parse_version(const std::string& text) {
    int major = 0;
    int minor = 0;
    int length = 0;
    const bool digits = std::all_of(text.begin(), text.end(),
                                    [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
    if (!digits || text.size() > 9 ||
        std::sscanf(text.c_str(), "%d.%d%n", &major, &minor, &length) != 2 ||
        static_cast<size_t>(length) != text.size()) {
        return std::nullopt;
    }
    return std::pair(major, minor);
}

void check_version(const Json& asset, Context& context) {
    const std::string version = asset["version"];
    const auto parsed = parse_version(version);
    if (!parsed || parsed->first != 2) {
        refuse("/asset/version", fmt::format("glTF version '{}'", version),
               "export it as glTF 2.0");
    }
    if (parsed->second != 0) {
        context.warn("/asset/version", fmt::format("read as 2.0 instead of {}", version));
    }
    if (asset.contains("minVersion")) {
        const auto needed = parse_version(asset["minVersion"]);
        if (!needed || *needed > *parsed || needed->first != 2 || needed->second > 0) {
            refuse("/asset/minVersion",
                   fmt::format("needs glTF {}", asset["minVersion"].get<std::string>()),
                   "export it as glTF 2.0");
        }
    }
}

std::set<std::string> strings_of(const Json& doc, const char* name) {
    return doc.contains(name) ? doc[name].get<std::set<std::string>>() : std::set<std::string>{};
}

/// Extensions this reader understands; those on nodes and scenes are handed on to whoever does.
bool is_read(const std::string& name) {
    return name == "KHR_lights_punctual" || name == "KHR_mesh_quantization" ||
           name == "KHR_materials_emissive_strength";
}

std::set<std::string> handed_on(const Json& doc) {
    std::set<std::string> names;
    for (const char* collection : {"nodes", "scenes"}) {
        for (const Json& object : member(doc, collection)) {
            for (const auto& [name, extension] : member(object, "extensions").items()) {
                names.insert(name);
            }
        }
    }
    return names;
}

void check_extensions(const Json& doc, const std::set<std::string>& present, Context& context) {
    const auto used = strings_of(doc, "extensionsUsed");
    const auto required = strings_of(doc, "extensionsRequired");
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        if (doc.contains(list) && doc[list].size() != strings_of(doc, list).size()) {
            context.warn(fmt::format("/{}", list), "names an extension twice");
        }
    }
    for (const std::string& name : present) {
        if (!used.contains(name)) {
            context.warn("/extensionsUsed", fmt::format("{} is used but not listed", name));
        }
    }
    const auto passed = handed_on(doc);
    for (const std::string& name : required) {
        if (name.ends_with("_compression")) {
            refuse("/extensionsRequired", fmt::format("{} is not supported", name),
                   "export it without compression");
        }
        if (!used.contains(name)) {
            context.warn("/extensionsRequired",
                         fmt::format("{} is required but not listed as used", name));
        }
    }
    for (const std::string& name : used) {
        if (!is_read(name) && !passed.contains(name)) {
            context.warn(
                "/extensionsUsed",
                fmt::format("{} is not read{}", name,
                            required.contains(name) ? ", though the file requires it" : ""));
        }
    }
}

}  // namespace

void check_schema(Json& doc, Context& context) {
    SchemaCheck check(doc, context);
    check.object("glTF", doc, "");
    check_version(doc["asset"], context);
    check_extensions(doc, check.extensions_used(), context);
}

}  // namespace vellus::asset::detail
