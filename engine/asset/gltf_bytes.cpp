#include <array>

#include "engine/asset/gltf_context.h"
#include "engine/platform/files.h"

namespace vellus::asset::detail {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// RFC 3986 percent-encoding; nothing where a % is not followed by two hexadecimal digits.
std::optional<std::string> percent_decode(std::string_view text) {
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            result += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0) {
            return std::nullopt;
        }
        result += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return result;
}

constexpr std::array<int8_t, 256> base64_table() {
    std::array<int8_t, 256> table{};
    table.fill(-1);
    constexpr std::string_view kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < kAlphabet.size(); ++i) {
        table[static_cast<uint8_t>(kAlphabet[i])] = static_cast<int8_t>(i);
    }
    return table;
}

/// RFC 4648 base64, with or without padding; nothing where it holds another character.
std::optional<std::vector<std::byte>> base64_decode(std::string_view text) {
    static constexpr std::array<int8_t, 256> kTable = base64_table();
    for (int pad = 0; pad < 2 && text.ends_with('='); ++pad) {
        text.remove_suffix(1);
    }
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    unsigned count = 0;
    for (const char c : text) {
        const int value = kTable[static_cast<uint8_t>(c)];
        if (value < 0) {
            return std::nullopt;
        }
        bits = bits << 6U | static_cast<uint32_t>(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> count));
        }
    }
    if (text.size() % 4 == 1) {
        return std::nullopt;
    }
    return bytes;
}

std::vector<std::byte> read_data_uri(std::string_view uri, const std::string& pointer) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        refuse(pointer, "a data URI without a comma", "export it again");
    }
    const std::string_view payload = uri.substr(comma + 1);
    if (uri.substr(0, comma).ends_with(";base64")) {
        if (auto bytes = base64_decode(payload)) {
            return std::move(*bytes);
        }
        refuse(pointer, "the data URI is no valid base64", "export it again");
    }
    const auto text = percent_decode(payload);
    if (!text) {
        refuse(pointer, "the data URI has a broken % code", "export it again");
    }
    const auto* first = reinterpret_cast<const std::byte*>(text->data());
    return {first, first + text->size()};
}

bool has_scheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    const size_t slash = uri.find('/');
    return colon != std::string_view::npos && colon > 0 &&
           (slash == std::string_view::npos || colon < slash);
}

std::vector<std::byte> read_relative_file(const std::string& uri, const std::string& pointer,
                                          const Context& context) {
    const auto name = percent_decode(uri);
    if (!name || name->empty() || name->find('\0') != std::string::npos) {
        refuse(pointer, fmt::format("'{}' is no file name", uri), "name a file beside the scene");
    }
    const std::filesystem::path path(*name);
    if (has_scheme(uri) || path.is_absolute() || name->front() == '\\') {
        refuse(pointer, fmt::format("'{}' is no relative path", uri.substr(0, 80)),
               "put the file beside the scene and name it relative to it");
    }
    if (context.base_dir.empty()) {
        refuse(pointer, fmt::format("'{}' is another file, but this scene comes from memory", uri),
               "embed the data, or load the scene from disk");
    }
    auto bytes = read_file(context.base_dir / path);
    if (!bytes) {
        refuse(pointer, fmt::format("{}: {}", bytes.error().where, bytes.error().what),
               "put the file where the scene expects it");
    }
    return std::move(*bytes);
}

}  // namespace

Bytes read_uri(const std::string& uri, const std::string& pointer, Context& context) {
    context.storage.push_back(uri.starts_with("data:") ? read_data_uri(uri, pointer)
                                                       : read_relative_file(uri, pointer, context));
    context.bytes_read += context.storage.back().size();
    return context.storage.back();
}

void read_buffers(const std::optional<Bytes>& bin, Context& context) {
    bool bin_used = false;
    const Json& buffers = member(context.doc, "buffers");
    for (size_t i = 0; i < buffers.size(); ++i) {
        const Json& buffer = buffers[i];
        const std::string pointer = fmt::format("/buffers/{}", i);
        const size_t length = buffer["byteLength"].get<size_t>();
        std::optional<Bytes> bytes;
        if (buffer.contains("uri")) {
            bytes = read_uri(buffer["uri"].get<std::string>(), pointer + "/uri", context);
        } else if (i == 0 && bin) {
            bytes = bin;
            bin_used = true;
            if (bin->size() > length + 3) {
                context.warn(pointer, fmt::format("{} bytes of the GLB's BIN chunk are not used",
                                                  bin->size() - length));
            }
        }
        if (bytes && bytes->size() < length) {
            refuse(pointer + "/byteLength",
                   fmt::format("{} bytes promised, {} there", length, bytes->size()),
                   "the file is cut off: export or copy it again");
        }
        if (!bytes) {
            context.warn(pointer, "no data: neither uri nor BIN chunk");
        }
        context.buffers.push_back(bytes ? std::optional(bytes->first(length)) : std::nullopt);
    }
    if (bin && !bin_used && !bin->empty()) {
        context.warn("/buffers", "no buffer uses the GLB's BIN chunk");
    }
}

}  // namespace vellus::asset::detail
