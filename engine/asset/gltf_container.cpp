#include <cstring>

#include "engine/asset/gltf_context.h"

// glTF 2.0 specification, chapter 4 (GLB) and 2.7 (JSON).
namespace vellus::asset::detail {
namespace {

constexpr uint32_t kMagic = 0x46546C67;
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr uint32_t kBinChunk = 0x004E4942;
constexpr const char* kExportAgain = "export it again";

/// Deeper JSON is refused: extensions are handed on as text, whose readers may recurse.
constexpr int kMaxJsonDepth = 64;

uint32_t word(Bytes file, size_t at) {
    if (file.size() < at + 4) {
        refuse("", "the GLB ends inside a header", kExportAgain);
    }
    uint32_t value = 0;
    std::memcpy(&value, file.data() + at, sizeof(value));
    return value;
}

/// Cuts the next chunk off `rest`.
std::pair<uint32_t, Bytes> next_chunk(Bytes& rest) {
    const uint32_t length = word(rest, 0);
    const uint32_t type = word(rest, 4);
    if (length % 4 != 0) {
        refuse("", fmt::format("a GLB chunk of {} bytes, which is no multiple of 4", length),
               kExportAgain);
    }
    if (length > rest.size() - 8) {
        refuse("",
               fmt::format("a GLB chunk of {} bytes where {} are left", length, rest.size() - 8),
               kExportAgain);
    }
    const Bytes chunk = rest.subspan(8, length);
    rest = rest.subspan(8 + size_t{length});
    return {type, chunk};
}

std::string_view text_of(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Bytes glb_body(Bytes file, Context& context) {
    const uint32_t version = word(file, 4);
    const uint32_t length = word(file, 8);
    if (version != 2) {
        refuse("", fmt::format("GLB version {}", version), "export it as glTF 2.0");
    }
    if (length > file.size() || length < 12) {
        refuse("", fmt::format("a GLB of {} bytes that says it has {}", file.size(), length),
               kExportAgain);
    }
    if (length < file.size()) {
        context.warn(
            "", fmt::format("{} bytes after the end of the GLB ignored", file.size() - length));
    }
    return file.subspan(12, length - 12);
}

/// The deepest nesting of objects and arrays, without parsing: brackets outside strings.
int json_depth(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            i += c == '\\' ? 1U : 0U;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

}  // namespace

const Json& member(const Json& object, const char* name) {
    static const Json kNull;
    const auto found = object.find(name);
    return found == object.end() ? kNull : *found;
}

Container open_container(Bytes file, Context& context) {
    if (file.size() < 4 || word(file, 0) != kMagic) {
        return {text_of(file), std::nullopt};
    }
    Bytes rest = glb_body(file, context);
    const auto [type, json] = next_chunk(rest);
    if (type != kJsonChunk) {
        refuse("", "the first chunk of the GLB is not JSON", kExportAgain);
    }
    Container container{text_of(json), std::nullopt};
    for (bool second = true; !rest.empty(); second = false) {
        const auto [other, bytes] = next_chunk(rest);
        if (other == kBinChunk && second) {
            container.bin = bytes;
        } else if (other == kBinChunk || other == kJsonChunk) {
            refuse("", "the GLB has more than one JSON or BIN chunk, or they are out of order",
                   kExportAgain);
        } else {
            context.warn("", fmt::format("GLB chunk of unknown type {:#x} ignored", other));
        }
    }
    return container;
}

Json parse_json(std::string_view text, Context& context) {
    if (text.starts_with("\xEF\xBB\xBF")) {
        context.warn("", "byte order mark ignored; glTF must not have one");
        text.remove_prefix(3);
    }
    if (json_depth(text) > kMaxJsonDepth) {
        refuse("", fmt::format("JSON nested deeper than {}", kMaxJsonDepth),
               "flatten extras and extensions");
    }
    try {
        Json doc = Json::parse(text);
        if (!doc.is_object()) {
            refuse("", "the JSON is no object", kExportAgain);
        }
        return doc;
    } catch (const Json::exception& e) {
        refuse("", fmt::format("neither GLB nor valid JSON: {}", e.what()),
               "open a .gltf or .glb file");
    }
}

}  // namespace vellus::asset::detail
