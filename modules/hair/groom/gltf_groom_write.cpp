#include <cmath>
#include <iterator>
#include <limits>

#include "modules/hair/groom/byte_io.h"
#include "modules/hair/groom/groom_file.h"

namespace vellus::hair {

namespace {

constexpr uint32_t kGlbMagic = 0x46546C67;
constexpr uint32_t kGlbVersion = 2;
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr uint32_t kBinaryChunk = 0x004E4942;

/// One attribute of all strands, back to back in the binary chunk; a strand's accessor is a range.
struct Attribute {
    const char* name;
    const char* type;
    size_t value_size;
    std::vector<std::byte> bytes;
};

Result<void> check_writable(const Groom& groom) {
    const std::string remedy = "load_groom() repairs, or choose .hair";
    if (groom.points.empty()) return Error{"no strands to write", "", ""};
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        if (groom.point_count(strand) < 2) {
            return Error{fmt::format("strand {} has {} points, a line strip needs two", strand,
                                     groom.point_count(strand)),
                         "", remedy};
        }
    }
    for (const glm::vec3& p : groom.points) {
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
        return Error{"a point is not finite, JSON cannot say its bounds", "", remedy};
    }
    return {};
}

std::vector<Attribute> collect_attributes(const Groom& groom) {
    std::vector<Attribute> attributes;
    Attribute positions{"POSITION", "VEC3", sizeof(glm::vec3), {}};
    append_values(positions.bytes, std::span<const glm::vec3>(groom.points));
    attributes.push_back(std::move(positions));

    Attribute colors{"COLOR_0", "VEC4", sizeof(glm::vec4), {}};
    Attribute thickness{"_THICKNESS", "SCALAR", sizeof(float), {}};
    Attribute uvs{"TEXCOORD_0", "VEC2", sizeof(glm::vec2), {}};
    const bool colored = !groom.colors.empty() || !groom.transparency.empty();
    const bool thick = !groom.thickness.empty() || groom.default_thickness > 0.0f;
    const bool mapped = !groom.point_uvs.empty() || !groom.strand_uvs.empty();
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        for (uint32_t p = groom.strand_begin[strand]; p < groom.strand_begin[strand + 1]; ++p) {
            if (colored) append_value(colors.bytes, linear_color_at(groom, p));
            if (thick) append_value(thickness.bytes, thickness_at(groom, strand, p));
            if (!mapped) continue;
            append_value(uvs.bytes,
                         groom.point_uvs.empty() ? groom.strand_uvs[strand] : groom.point_uvs[p]);
        }
    }
    for (Attribute* attribute : {&colors, &thickness, &uvs}) {
        if (!attribute->bytes.empty()) attributes.push_back(std::move(*attribute));
    }
    return attributes;
}

/// The accessors of one strand, one per attribute.
void write_accessors(std::string& out, const Groom& groom, const std::vector<Attribute>& attributes,
                     size_t strand) {
    const size_t first = groom.strand_begin[strand];
    for (size_t view = 0; view < attributes.size(); ++view) {
        fmt::format_to(std::back_inserter(out),
                       R"({}{{"bufferView":{},"byteOffset":{},"componentType":5126,"count":{},)"
                       R"("type":"{}")",
                       strand + view == 0 ? "" : ",", view, first * attributes[view].value_size,
                       groom.point_count(strand), attributes[view].type);
        if (view == 0) {
            Bounds box;
            for (uint32_t p = 0; p < groom.point_count(strand); ++p) {
                box.add(groom.points[first + p]);
            }
            fmt::format_to(std::back_inserter(out), R"(,"min":[{},{},{}],"max":[{},{},{}])",
                           box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z);
        }
        out += '}';
    }
}

void write_primitives(std::string& out, const Groom& groom,
                      const std::vector<Attribute>& attributes) {
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        out += strand == 0 ? R"({"mode":3,"attributes":{)" : R"(,{"mode":3,"attributes":{)";
        for (size_t i = 0; i < attributes.size(); ++i) {
            fmt::format_to(std::back_inserter(out), R"({}"{}":{})", i == 0 ? "" : ",",
                           attributes[i].name, strand * attributes.size() + i);
        }
        out += groom.has_default_color ? R"(},"material":0})" : "}}";
    }
}

std::string write_json(const Groom& groom, const std::vector<Attribute>& attributes,
                       size_t binary_size) {
    std::string out = R"({"asset":{"version":"2.0","generator":"Vellus"},"scene":0,)"
                      R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)";
    fmt::format_to(std::back_inserter(out), R"("buffers":[{{"byteLength":{}}}],"bufferViews":[)",
                   binary_size);
    size_t offset = 0;
    for (size_t i = 0; i < attributes.size(); ++i) {
        fmt::format_to(std::back_inserter(out),
                       R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", i == 0 ? "" : ",",
                       offset, attributes[i].bytes.size());
        offset += attributes[i].bytes.size();
    }
    out += R"(],"accessors":[)";
    for (size_t s = 0; s < groom.strand_count(); ++s) write_accessors(out, groom, attributes, s);
    out += "],";
    if (groom.has_default_color) {
        const glm::vec3 color = linear_default_color(groom);
        fmt::format_to(std::back_inserter(out),
                       R"("materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":)"
                       R"([{},{},{},1]}}}}],)",
                       color.r, color.g, color.b);
    }
    out += R"("meshes":[{"primitives":[)";
    write_primitives(out, groom, attributes);
    out += "]}]}";
    out.append((4 - out.size() % 4) % 4, ' ');
    return out;
}

}  // namespace

Result<std::vector<std::byte>> write_glb(const Groom& groom) {
    if (auto writable = check_writable(groom); !writable) return writable.error();
    const std::vector<Attribute> attributes = collect_attributes(groom);
    size_t binary_size = 0;
    for (const Attribute& attribute : attributes) binary_size += attribute.bytes.size();
    const std::string json = write_json(groom, attributes, binary_size);

    const uint64_t total = 12 + 8 + json.size() + 8 + binary_size;
    if (total > std::numeric_limits<uint32_t>::max()) {
        return Error{fmt::format("{} bytes, .glb holds 4 GiB", total), "",
                     "choose .hair, or split the groom"};
    }
    std::vector<std::byte> bytes;
    bytes.reserve(total);
    for (const uint32_t word : {kGlbMagic, kGlbVersion, static_cast<uint32_t>(total),
                                static_cast<uint32_t>(json.size()), kJsonChunk}) {
        append_value(bytes, word);
    }
    append_values(bytes, std::span<const char>(json));
    append_value(bytes, static_cast<uint32_t>(binary_size));
    append_value(bytes, kBinaryChunk);
    for (const Attribute& attribute : attributes) {
        append_values(bytes, std::span<const std::byte>(attribute.bytes));
    }
    return bytes;
}

}  // namespace vellus::hair
