#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "engine/platform/result.h"

namespace vellus::hair {

enum class GrowStyle : uint8_t {
    kStraight,
    kBob,
    kWavy,
    kCurly,
    kCoily,
    kPonytail,
    kBraid,
    kShort,
    kFur,
};

/// How hair grows; preset() fills it for a style. Lengths are metres on a human-sized head: on a
/// larger or smaller scalp scale them with it (scale_to()).
struct GrowSettings {
    GrowStyle style = GrowStyle::kStraight;
    float length = 0.40f;
    float length_variation = 0.12f;  ///< share by which the shortest hair is shorter
    /// Strands; 0: from `density`.
    uint32_t count = 16'000;
    float density =
        20.0f;             ///< strands per square centimetre of fully haired skin, where count is 0
    uint32_t points = 16;  ///< of each strand
    uint32_t guides = 320;
    float width = 0.00009f;  ///< diameter at the root
    float taper = 0.65f;     ///< share of the width that is gone at the tip

    float clumping = 0.35f;     ///< how far strands join their lock towards the tip
    float clump_size = 0.014f;  ///< distance between locks at the roots
    float curl = 0.0f;          ///< radius of the helix (of the wave, for wavy hair)
    float curl_period = 0.10f;  ///< of one turn, along the middle line
    float frizz = 0.25f;        ///< how restless the single hair is; 1 strays by about a centimetre
    float flyaways = 0.02f;     ///< share of strands that stand off

    float parting = 0.25f;  ///< where hair parts: -1 right ear, 0 middle, 1 left ear of the person
    float parted = 1.0f;    ///< 0: hair falls from the crown to all sides
    float lift = 0.30f;     ///< how steeply hair leaves the skin: 0 flat, 1 upright
    float stiffness = 0.25f;  ///< how long it keeps that direction: 0 falls at once, 1 never
    float volume = 1.0f;      ///< thickness of the coat over the skin, 1 is about a centimetre
    float face = 1.0f;        ///< how much of the face is kept free, 0 none
    /// Where the comb pulls short hair and fur, along the skin; the head looks along +Z.
    glm::vec3 comb{0.0f, -0.3f, -1.0f};
};

/// Settings that look like their name.
GrowSettings preset(GrowStyle style);

std::span<const std::string_view> grow_style_names();
std::string_view grow_style_name(GrowStyle style);
/// An Error that lists the names where there is no such style.
Result<GrowStyle> grow_style(std::string_view name);

/// A number of GrowSettings as people set it.
struct GrowField {
    std::string_view name;
    std::string_view help;
    float low = 0.0f;
    float high = 1.0f;
    float GrowSettings::*value = nullptr;
};
std::span<const GrowField> grow_fields();

/// An Error that names the first field out of its range, and the range.
Result<void> check(const GrowSettings& settings);

/// All lengths times `factor`, the density over its square.
GrowSettings scale_to(const GrowSettings& settings, float factor);

constexpr uint32_t kMostStrands = 4'000'000;
constexpr uint32_t kMostStrandPoints = 512;

}  // namespace vellus::hair
