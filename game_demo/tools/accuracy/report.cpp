#include "game_demo/tools/accuracy/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "engine/platform/log.h"
#include "game_demo/tools/accuracy/page_template.h"
#include "game_demo/tools/accuracy/pictures.h"

namespace vellus::demo {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) {
            word =
                word << 8U | (i + k < bytes.size() ? std::to_integer<uint32_t>(bytes[i + k]) : 0U);
        }
        for (size_t k = 0; k < 4; ++k) {
            const bool padding = i + k > bytes.size();
            text += padding ? '=' : kDigits[word >> (18U - 6U * k) & 63U];
        }
    }
    return text;
}

/// The picture as a data: URI; empty where it cannot be read.
std::string data_uri(const fs::path& file) {
    const auto image = asset::load_image(file);
    if (!image) return {};
    const auto bytes = encode_jpeg(*image);
    return bytes ? "data:image/jpeg;base64," + base64(*bytes) : "";
}

/// Pictures by the name rows give them, each once.
Json pictures_of(const AccuracyTable& table, const fs::path& folder) {
    std::set<std::string> files;
    for (const AccuracyRow& row : table.rows)
        files.insert(row.pictures.begin(), row.pictures.end());
    Json pictures = Json::object();
    for (const std::string& file : files) {
        const std::string uri = file.empty() ? "" : data_uri(folder / file);
        if (!uri.empty()) pictures[file] = uri;
    }
    return pictures;
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted.append(c == '"' ? "\"\"" : std::string(1, c));
    return quoted + '"';
}

/// Replaces the line that is nothing but `mark`.
void put(std::string& page, const std::string& mark, std::string_view text) {
    const size_t at = page.find(mark);
    if (at != std::string::npos) page.replace(at, mark.size(), text);
}

}  // namespace

std::string to_csv(const AccuracyTable& table) {
    std::set<std::string> measures;
    for (const AccuracyRow& row : table.rows) {
        for (const auto& [name, value] : row.measures) measures.insert(name);
    }
    std::string text = "axis,technique,setting,groom,colour,light,error";
    for (const std::string& name : measures) text += "," + name;
    text +=
        ",axis_ms,axis_ms_p10,axis_ms_p90,frame_ms,frame_ms_p10,frame_ms_p90,transient_bytes,"
        "persistent_bytes,frames,device\n";
    for (const AccuracyRow& row : table.rows) {
        text += fmt::format("{},{},{},{},{},{},{:.6g}", row.axis, csv_field(row.technique),
                            csv_field(row.setting), row.groom, row.colour, row.light, row.error);
        for (const std::string& name : measures) {
            const auto found = row.measures.find(name);
            text += found == row.measures.end() ? "," : fmt::format(",{:.6g}", found->second);
        }
        for (const Spread& spread : {row.axis_ms, row.frame_ms}) {
            text += fmt::format(",{:.4f},{:.4f},{:.4f}", spread.median, spread.low, spread.high);
        }
        text += fmt::format(",{},{},{},{}\n", row.transient_bytes, row.persistent_bytes, row.frames,
                            csv_field(row.device));
    }
    return text;
}

std::string escape_html(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string escape_script(std::string json) {
    for (size_t at = 0; (at = json.find('<', at)) != std::string::npos;) {
        json.replace(at, 1, "\\u003c");
    }
    return json;
}

std::string to_html(const AccuracyTable& table, const fs::path& folder) {
    Json data = Json::parse(to_json(table));
    Json errors = Json::object();
    for (const AccuracyRow& row : table.rows) errors[row.axis] = error_name(row.axis);
    data["errors"] = errors;
    data["files"] = pictures_of(table, folder);
    const PageTemplate& parts = page_template();
    std::string page(parts.html);
    put(page, "@device@", escape_html(table.device));
    put(page, "@css@", parts.css);
    put(page, "@js@", parts.js);
    put(page, "@data@", escape_script(data.dump(-1, ' ', false, Json::error_handler_t::replace)));
    return page;
}

AccuracyTable frames_alone(const AccuracyTable& table) {
    AccuracyTable frames = table;
    std::erase_if(frames.rows, [](const AccuracyRow& row) { return row.axis != kFrameAxis; });
    for (AccuracyRow& row : frames.rows) row.pictures = {};
    return frames;
}

Result<void> write_reports(const fs::path& folder, const AccuracyTable& table) {
    if (auto done = write_file(folder / "accuracy.csv", to_csv(table)); !done) return done;
    if (auto done = write_file(folder / "accuracy.json", to_json(table)); !done) return done;
    if (auto done = write_file(folder / "frames.json", to_json(frames_alone(table))); !done) {
        return done;
    }
    return write_file(folder / "accuracy.html", to_html(table, folder));
}

}  // namespace vellus::demo
