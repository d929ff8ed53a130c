#pragma once

#include <cstdlib>
#include <cstring>
#include <span>

#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/groom/upright.h"
#include "tests/fuzz/fuzz.h"

// What must hold of a groom read from any bytes; shared by the targets of the formats.
namespace vellus::fuzz {

inline Bytes to_bytes(const Result<std::vector<std::byte>>& bytes) {
    if (!bytes) std::abort();
    const auto* first = reinterpret_cast<const uint8_t*>(bytes->data());
    return {first, first + bytes->size()};
}

/// Four short strands, of equal length or not, with every optional column or none.
inline hair::Groom sample_groom(bool varied, bool columns) {
    hair::Groom groom;
    for (uint32_t strand = 0; strand < 4; ++strand) {
        const uint32_t count = varied ? 2 + strand : 3;
        for (uint32_t i = 0; i < count; ++i) {
            const auto along = static_cast<float>(i);
            groom.points.emplace_back(static_cast<float>(strand), along, 0.5f * along);
            if (!columns) continue;
            groom.thickness.push_back(0.1f);
            groom.transparency.push_back(0.25f);
            groom.colors.emplace_back(0.5f, 0.25f, 0.125f, 1.0f);
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
        if (columns) groom.strand_uvs.emplace_back(0.5f, 0.25f);
    }
    return groom;
}

inline void require(bool holds) {
    if (!holds) std::abort();
}

inline bool same_points(const hair::Groom& a, const hair::Groom& b) {
    return a.strand_begin == b.strand_begin && a.points.size() == b.points.size() &&
           (a.points.empty() || std::memcmp(a.points.data(), b.points.data(),
                                            a.points.size() * sizeof(glm::vec3)) == 0);
}

/// Every consumer must survive the repaired groom, and what is written must read back.
template <class Write, class Read>
void check_groom(Result<hair::Groom> groom, const Write& write, const Read& read) {
    if (!groom) return require(!groom.error().what.empty());
    const auto bytes = write(*groom);
    if (bytes) {
        const auto again = read(*bytes, "again");
        require(static_cast<bool>(again) && same_points(*again, *groom));
    }
    const hair::GroomReport report = hair::repair(*groom);
    require(report.strands == groom->strand_count() && report.points == groom->points.size());
    const hair::Upright upright = hair::upright_transform(*groom);
    const auto width = static_cast<float>(hair::default_width(*groom, upright.metres_per_unit));
    const hair::StrandData data = hair::prepare_strands(*groom, upright.to_metres, width);
    require(data.segment_count() + data.strand_count() == data.positions.size());
    require(width > 0.0f && !hair::to_text(report).empty());
}

}  // namespace vellus::fuzz
