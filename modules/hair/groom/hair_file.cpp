#include <algorithm>
#include <array>
#include <limits>

#include "modules/hair/groom/byte_io.h"
#include "modules/hair/groom/groom_file.h"

// The HAIR file format of Cem Yuksel (cemyuksel.com/research/hairmodels): a header of 128 bytes,
// then the arrays whose header bit is set, in the order of their bits.
namespace vellus::hair {

namespace {

enum HeaderBit : uint32_t {
    kSegmentsBit = 1,
    kPointsBit = 2,
    kThicknessBit = 4,
    kTransparencyBit = 8,
    kColorsBit = 16,
    kAllBits = 31,
};

struct HairHeader {
    std::array<char, 4> magic{'H', 'A', 'I', 'R'};
    uint32_t strands = 0;
    uint32_t points = 0;
    uint32_t bits = 0;
    uint32_t segments = 0;
    float thickness = 0.0f;
    float transparency = 0.0f;
    std::array<float, 3> color{};
    std::array<char, 88> info{};
};
static_assert(sizeof(HairHeader) == 128);

constexpr uint32_t kMostSegments = std::numeric_limits<uint16_t>::max();

Error broken(std::string what, const std::string& where) {
    return {std::move(what), where, "is the file whole, and a .hair file?"};
}

/// Bytes that the arrays named in the header take, or an Error if the file is shorter.
Result<void> check_size(const HairHeader& header, size_t size, const std::string& where) {
    const uint64_t points = header.points;
    uint64_t need = sizeof(HairHeader) + points * sizeof(glm::vec3);
    if (header.bits & kSegmentsBit) need += uint64_t{header.strands} * sizeof(uint16_t);
    if (header.bits & kThicknessBit) need += points * sizeof(float);
    if (header.bits & kTransparencyBit) need += points * sizeof(float);
    if (header.bits & kColorsBit) need += points * sizeof(glm::vec3);
    if (need <= size) return {};
    return broken(fmt::format("header announces {} strands and {} points in {} bytes, file has {}",
                              header.strands, header.points, need, size),
                  where);
}

/// Fills strand_begin from the segments array or the header's constant.
Result<void> read_strands(const HairHeader& header, std::span<const std::byte> bytes, Groom& groom,
                          const std::string& where) {
    const bool listed = (header.bits & kSegmentsBit) != 0;
    if (!listed &&
        uint64_t{header.strands} * (uint64_t{header.segments} + 1) != uint64_t{header.points}) {
        return broken(
            fmt::format("{} strands of {} segments need {} points, header says {}", header.strands,
                        header.segments, uint64_t{header.strands} * (uint64_t{header.segments} + 1),
                        header.points),
            where);
    }
    groom.strand_begin.resize(size_t{header.strands} + 1);
    uint64_t point = 0;
    for (size_t strand = 0; strand < header.strands; ++strand) {
        groom.strand_begin[strand] = static_cast<uint32_t>(point);
        const size_t offset = sizeof(HairHeader) + strand * sizeof(uint16_t);
        point += 1 + (listed ? copy_value<uint16_t>(bytes, offset) : header.segments);
        if (point > header.points) break;
    }
    if (point != header.points) {
        return broken(fmt::format("the segments array needs {}{} points, header says {}",
                                  point > header.points ? "at least " : "", point, header.points),
                      where);
    }
    groom.strand_begin.back() = header.points;
    return {};
}

void read_arrays(const HairHeader& header, std::span<const std::byte> bytes, Groom& groom) {
    const size_t points = header.points;
    size_t offset = sizeof(HairHeader);
    if (header.bits & kSegmentsBit) offset += size_t{header.strands} * sizeof(uint16_t);
    groom.points = copy_values<glm::vec3>(bytes, offset, points);
    offset += points * sizeof(glm::vec3);
    if (header.bits & kThicknessBit) {
        groom.thickness = copy_values<float>(bytes, offset, points);
        offset += points * sizeof(float);
    }
    if (header.bits & kTransparencyBit) {
        groom.transparency = copy_values<float>(bytes, offset, points);
        offset += points * sizeof(float);
    }
    if (header.bits & kColorsBit) {
        const auto colors = copy_values<glm::vec3>(bytes, offset, points);
        groom.colors.resize(points);
        std::ranges::transform(colors, groom.colors.begin(),
                               [](glm::vec3 color) { return glm::vec4(color, 1.0f); });
        offset += points * sizeof(glm::vec3);
    }
    if (header.bits & ~kAllBits) {
        groom.notes.push_back(fmt::format(
            "header bits {:#x} are not defined by the format: ignored", header.bits & ~kAllBits));
    }
    if (offset < bytes.size()) {
        groom.notes.push_back(
            fmt::format("{} bytes after the last array: ignored", bytes.size() - offset));
    }
}

bool uniform_segments(const Groom& groom) {
    for (size_t strand = 1; strand < groom.strand_count(); ++strand) {
        if (groom.point_count(strand) != groom.point_count(0)) return false;
    }
    return true;
}

Result<void> check_writable(const Groom& groom) {
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        const uint32_t points = groom.point_count(strand);
        if (points == 0 || points - 1 > kMostSegments) {
            return Error{fmt::format("strand {} has {} points, .hair holds 1 to {}", strand, points,
                                     kMostSegments + 1),
                         "", "drop the strand or choose another format"};
        }
    }
    return {};
}

HairHeader header_of(const Groom& groom) {
    HairHeader header;
    header.strands = static_cast<uint32_t>(groom.strand_count());
    header.points = static_cast<uint32_t>(groom.points.size());
    header.bits = kPointsBit;
    if (!uniform_segments(groom)) {
        header.bits |= kSegmentsBit;
    } else if (header.strands > 0) {
        header.segments = groom.point_count(0) - 1;
    }
    if (!groom.thickness.empty()) header.bits |= kThicknessBit;
    const bool alpha = std::ranges::any_of(groom.colors, [](auto c) { return c.a != 1.0f; });
    if (!groom.transparency.empty() || alpha) header.bits |= kTransparencyBit;
    if (!groom.colors.empty()) header.bits |= kColorsBit;
    header.thickness = groom.default_thickness;
    header.transparency = groom.default_transparency;
    header.color = {groom.default_color.r, groom.default_color.g, groom.default_color.b};
    std::copy_n(groom.info.begin(), std::min(groom.info.size(), header.info.size()),
                header.info.begin());
    return header;
}

}  // namespace

Result<Groom> read_hair(std::span<const std::byte> bytes, const std::string& where) {
    if (bytes.size() < sizeof(HairHeader)) {
        return broken(fmt::format("{} bytes, a .hair header has 128", bytes.size()), where);
    }
    const auto header = copy_value<HairHeader>(bytes, 0);
    if (header.magic != HairHeader{}.magic) return broken("does not begin with HAIR", where);
    if (!(header.bits & kPointsBit)) return broken("has no points array (header bit 1)", where);
    if (auto sized = check_size(header, bytes.size(), where); !sized) return sized.error();

    Groom groom;
    groom.format = GroomFormat::kHair;
    if (auto strands = read_strands(header, bytes, groom, where); !strands) return strands.error();
    read_arrays(header, bytes, groom);
    groom.default_thickness = header.thickness;
    groom.default_transparency = header.transparency;
    groom.default_color = {header.color[0], header.color[1], header.color[2]};
    // What writers leave there when nobody chose a colour: zeros, or the white of the author's
    // library.
    groom.has_default_color =
        groom.default_color != glm::vec3(0.0f) && groom.default_color != glm::vec3(1.0f);
    groom.info.assign(header.info.begin(), std::ranges::find(header.info, '\0'));
    return groom;
}

Result<std::vector<std::byte>> write_hair(const Groom& groom) {
    if (auto writable = check_writable(groom); !writable) return writable.error();
    const HairHeader header = header_of(groom);
    std::vector<std::byte> bytes;
    append_value(bytes, header);
    if (header.bits & kSegmentsBit) {
        for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
            append_value(bytes, static_cast<uint16_t>(groom.point_count(strand) - 1));
        }
    }
    append_values(bytes, std::span<const glm::vec3>(groom.points));
    if (header.bits & kThicknessBit) {
        for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
            for (uint32_t p = groom.strand_begin[strand]; p < groom.strand_begin[strand + 1]; ++p) {
                append_value(bytes, thickness_at(groom, strand, p));
            }
        }
    }
    if (header.bits & kTransparencyBit) {
        for (size_t point = 0; point < groom.points.size(); ++point) {
            append_value(bytes, transparency_at(groom, point));
        }
    }
    for (const glm::vec4& color : groom.colors) append_value(bytes, glm::vec3(color));
    return bytes;
}

}  // namespace vellus::hair
