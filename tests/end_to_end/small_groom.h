#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "modules/hair/groom/groom_file.h"

namespace vellus::test {

/// Writes a small groom: strands that hang from a disc of 20 cm, in a file of our own.
inline std::filesystem::path write_small_groom(const std::filesystem::path& folder) {
    hair::Groom groom;
    groom.format = hair::GroomFormat::kTfx4;
    constexpr int kStrands = 400;
    constexpr int kPoints = 8;
    for (int strand = 0; strand < kStrands; ++strand) {
        const float angle = 2.4f * static_cast<float>(strand);  // the golden angle spreads evenly
        const float radius = 0.1f * std::sqrt(static_cast<float>(strand) / kStrands);
        for (int point = 0; point < kPoints; ++point) {
            const float drop = 0.03f * static_cast<float>(point);
            groom.points.emplace_back(radius * std::cos(angle) * (1.0f + drop), 0.2f - drop,
                                      radius * std::sin(angle) * (1.0f + drop));
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    auto path = folder / "small.tfx";
    const auto saved = hair::save_groom(groom, path);
    EXPECT_TRUE(saved) << saved.error().message();
    return path;
}

}  // namespace vellus::test
