#include <algorithm>
#include <array>
#include <limits>

#include "modules/hair/groom/byte_io.h"
#include "modules/hair/groom/groom_file.h"

// TressFX strand files of AMD: a header with the numbers of strands and of points per strand, and
// byte offsets of the arrays (0: absent). Versions 3.x keep three floats per position and a header
// of 296 bytes, versions 4.x four floats (w is 0 where the point is held) and 160 bytes.
namespace vellus::hair {

namespace {

struct Tfx3Header {
    float version = 3.0f;
    uint32_t strands = 0;
    uint32_t points_per_strand = 0;
    uint32_t follow_per_guide = 0;
    uint32_t both_ends_held = 0;
    std::array<uint32_t, 31> reserved1{};
    uint32_t positions = 0;
    uint32_t strand_thickness = 0;
    uint32_t strand_uv = 0;
    uint32_t point_color = 0;
    uint32_t guide_index = 0;
    uint32_t point_uv = 0;
    std::array<uint32_t, 32> reserved2{};
};
static_assert(sizeof(Tfx3Header) == 296);

struct Tfx4Header {
    float version = 4.0f;
    uint32_t strands = 0;
    uint32_t points_per_strand = 0;
    uint32_t positions = 0;
    uint32_t strand_uv = 0;
    uint32_t point_uv = 0;
    uint32_t strand_thickness = 0;
    uint32_t point_color = 0;
    std::array<uint32_t, 32> reserved{};
};
static_assert(sizeof(Tfx4Header) == 160);

/// What both versions say, with the size of a position.
struct Layout {
    GroomFormat format = GroomFormat::kNone;
    size_t header_size = 0;
    size_t position_size = 0;
    uint32_t strands = 0;
    uint32_t points_per_strand = 0;
    uint32_t positions = 0;
    uint32_t strand_uv = 0;
    uint32_t point_uv = 0;
    uint32_t strand_thickness = 0;
    uint32_t point_color = 0;

    [[nodiscard]] uint64_t points() const { return uint64_t{strands} * points_per_strand; }
};

Error broken(std::string what, const std::string& where) {
    return {std::move(what), where, "is the file whole, and a TressFX 3.x or 4.x file?"};
}

template <class Header>
Layout layout_of(const Header& header, GroomFormat format, size_t position_size) {
    return {.format = format,
            .header_size = sizeof(Header),
            .position_size = position_size,
            .strands = header.strands,
            .points_per_strand = header.points_per_strand,
            .positions = header.positions,
            .strand_uv = header.strand_uv,
            .point_uv = header.point_uv,
            .strand_thickness = header.strand_thickness,
            .point_color = header.point_color};
}

Result<Layout> read_layout(std::span<const std::byte> bytes, const std::string& where) {
    if (bytes.size() < sizeof(Tfx4Header)) {
        return broken(fmt::format("{} bytes, a .tfx header has at least 160", bytes.size()), where);
    }
    const auto version = copy_value<float>(bytes, 0);
    if (!(version >= 3.0f && version < 5.0f)) {
        return broken(fmt::format("version {} is not supported", version), where);
    }
    if (version >= 4.0f) {
        return layout_of(copy_value<Tfx4Header>(bytes, 0), GroomFormat::kTfx4, sizeof(glm::vec4));
    }
    if (bytes.size() < sizeof(Tfx3Header)) {
        return broken(fmt::format("{} bytes, a .tfx 3 header has 296", bytes.size()), where);
    }
    return layout_of(copy_value<Tfx3Header>(bytes, 0), GroomFormat::kTfx3, sizeof(glm::vec3));
}

Result<void> check_layout(const Layout& layout, size_t size, const std::string& where) {
    if (layout.strands > 0 && layout.points_per_strand == 0) {
        return broken(fmt::format("{} strands of no points", layout.strands), where);
    }
    if (layout.points() >= std::numeric_limits<uint32_t>::max()) {
        return broken(fmt::format("{} points, more than the {} that fit", layout.points(),
                                  std::numeric_limits<uint32_t>::max() - 1),
                      where);
    }
    struct Array {
        const char* name;
        uint32_t offset;
        uint64_t count;
        size_t value_size;
    };
    const std::array<Array, 5> arrays = {{
        {"positions", layout.positions, layout.points(), layout.position_size},
        {"strand UVs", layout.strand_uv, layout.strands, sizeof(glm::vec2)},
        {"point UVs", layout.point_uv, layout.points(), sizeof(glm::vec2)},
        {"strand thickness", layout.strand_thickness, layout.strands, sizeof(float)},
        {"point colours", layout.point_color, layout.points(), sizeof(glm::vec4)},
    }};
    for (const Array& array : arrays) {
        const bool needed = &array == arrays.data() && array.count > 0;
        if (array.offset == 0 && !needed) continue;
        if (array.offset >= layout.header_size &&
            fits(size, array.offset, array.count, array.value_size)) {
            continue;
        }
        return broken(fmt::format("{}: {} values of {} bytes at offset {} do not fit {} bytes",
                                  array.name, array.count, array.value_size, array.offset, size),
                      where);
    }
    return {};
}

void read_positions(const Layout& layout, std::span<const std::byte> bytes, Groom& groom) {
    const size_t count = layout.points();
    if (layout.format == GroomFormat::kTfx3) {
        groom.points = copy_values<glm::vec3>(bytes, layout.positions, count);
        return;
    }
    groom.points.resize(count);
    groom.inverse_mass.resize(count);
    for (size_t point = 0; point < count; ++point) {
        const auto value =
            copy_value<glm::vec4>(bytes, layout.positions + point * sizeof(glm::vec4));
        groom.points[point] = glm::vec3(value);
        groom.inverse_mass[point] = value.w;
    }
}

/// The number of points every strand has; an Error if they differ.
Result<uint32_t> common_point_count(const Groom& groom) {
    const uint32_t count = groom.strand_count() == 0 ? 0 : groom.point_count(0);
    for (size_t strand = 1; strand < groom.strand_count(); ++strand) {
        if (groom.point_count(strand) == count) continue;
        return Error{fmt::format("strand 0 has {} points, strand {} has {}; .tfx needs the same",
                                 count, strand, groom.point_count(strand)),
                     "", "choose .hair or .glb, or resample the strands"};
    }
    return count;
}

/// Where the next array of `count` values begins; offsets of the format have 32 bits.
class Placer {
  public:
    explicit Placer(uint64_t begin) : end_(begin) {}
    uint32_t place(uint64_t count, uint64_t value_size) {
        const uint64_t offset = end_;
        end_ += (count * value_size + 7) / 8 * 8;
        return count == 0 ? 0 : static_cast<uint32_t>(offset);
    }
    [[nodiscard]] uint64_t end() const { return end_; }

  private:
    uint64_t end_;
};

void pad_to_eight(std::vector<std::byte>& bytes) {
    bytes.resize((bytes.size() + 7) / 8 * 8);
}

void append_positions(std::vector<std::byte>& bytes, const Groom& groom) {
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        const uint32_t first = groom.strand_begin[strand];
        for (uint32_t p = first; p < groom.strand_begin[strand + 1]; ++p) {
            const float rooted = p == first ? 0.0f : 1.0f;
            const float w = groom.inverse_mass.empty() ? rooted : groom.inverse_mass[p];
            append_value(bytes, glm::vec4(groom.points[p], w));
        }
    }
}

void append_thickness(std::vector<std::byte>& bytes, const Groom& groom) {
    for (size_t strand = 0; strand < groom.strand_count(); ++strand) {
        append_value(bytes, thickness_at(groom, strand, groom.strand_begin[strand]));
    }
    pad_to_eight(bytes);
}

}  // namespace

Result<Groom> read_tfx(std::span<const std::byte> bytes, const std::string& where) {
    auto found = read_layout(bytes, where);
    if (!found) return found.error();
    const Layout& layout = *found;
    if (auto checked = check_layout(layout, bytes.size(), where); !checked) return checked.error();

    Groom groom;
    groom.format = layout.format;
    groom.strand_begin.resize(size_t{layout.strands} + 1);
    for (size_t strand = 0; strand < groom.strand_begin.size(); ++strand) {
        groom.strand_begin[strand] = static_cast<uint32_t>(strand * layout.points_per_strand);
    }
    read_positions(layout, bytes, groom);
    if (layout.strand_uv != 0) {
        groom.strand_uvs = copy_values<glm::vec2>(bytes, layout.strand_uv, layout.strands);
    }
    if (layout.point_uv != 0) {
        groom.point_uvs = copy_values<glm::vec2>(bytes, layout.point_uv, layout.points());
    }
    if (layout.strand_thickness != 0) {
        groom.thickness = copy_values<float>(bytes, layout.strand_thickness, layout.strands);
    }
    if (layout.point_color != 0) {
        groom.colors = copy_values<glm::vec4>(bytes, layout.point_color, layout.points());
    }
    return groom;
}

Result<std::vector<std::byte>> write_tfx(const Groom& groom) {
    auto points = common_point_count(groom);
    if (!points) return points.error();

    Tfx4Header header;
    header.strands = static_cast<uint32_t>(groom.strand_count());
    header.points_per_strand = *points;
    const bool thick = !groom.thickness.empty() || groom.default_thickness > 0.0f;
    const bool colored = has_colors(groom) || !groom.transparency.empty();
    Placer placer(sizeof(header));
    header.positions = placer.place(groom.points.size(), sizeof(glm::vec4));
    header.strand_uv = placer.place(groom.strand_uvs.size(), sizeof(glm::vec2));
    header.point_uv = placer.place(groom.point_uvs.size(), sizeof(glm::vec2));
    header.strand_thickness = placer.place(thick ? header.strands : 0, sizeof(float));
    header.point_color = placer.place(colored ? groom.points.size() : 0, sizeof(glm::vec4));
    if (placer.end() > std::numeric_limits<uint32_t>::max()) {
        return Error{fmt::format("{} bytes, .tfx holds 4 GiB", placer.end()), "",
                     "choose .hair, or split the groom"};
    }

    std::vector<std::byte> bytes;
    bytes.reserve(placer.end());
    append_value(bytes, header);
    append_positions(bytes, groom);
    append_values(bytes, std::span<const glm::vec2>(groom.strand_uvs));
    append_values(bytes, std::span<const glm::vec2>(groom.point_uvs));
    if (thick) append_thickness(bytes, groom);
    if (colored) {
        for (size_t p = 0; p < groom.points.size(); ++p) append_value(bytes, color_at(groom, p));
    }
    return bytes;
}

}  // namespace vellus::hair
