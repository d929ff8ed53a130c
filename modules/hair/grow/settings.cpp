#include "modules/hair/grow/settings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vellus::hair {

namespace {

constexpr std::array<std::string_view, 9> kStyleNames = {
    "straight", "bob", "wavy", "curly", "coily", "ponytail", "braid", "short", "fur"};

using S = GrowSettings;
constexpr std::array kFields = {
    GrowField{"length", "metres from root to tip", 0.001f, 10.0f, &S::length},
    GrowField{"length-variation", "share by which the shortest hair is shorter", 0.0f, 1.0f,
              &S::length_variation},
    GrowField{"density", "strands per cm2 of skin, where no count is given", 0.001f, 10'000.0f,
              &S::density},
    GrowField{"width", "diameter at the root in metres", 1e-6f, 0.05f, &S::width},
    GrowField{"taper", "share of the width that is gone at the tip", 0.0f, 1.0f, &S::taper},
    GrowField{"clumping", "how far strands join their lock towards the tip", 0.0f, 1.0f,
              &S::clumping},
    GrowField{"clump-size", "metres between locks at the roots", 1e-4f, 1.0f, &S::clump_size},
    GrowField{"curl", "radius of the curl in metres", 0.0f, 1.0f, &S::curl},
    GrowField{"curl-period", "metres of one turn along the middle line", 1e-3f, 10.0f,
              &S::curl_period},
    GrowField{"frizz", "restlessness of the single hair", 0.0f, 4.0f, &S::frizz},
    GrowField{"flyaways", "share of strands that stand off", 0.0f, 1.0f, &S::flyaways},
    GrowField{"parting", "-1 right ear, 0 middle, 1 left ear", -1.0f, 1.0f, &S::parting},
    GrowField{"parted", "0 falls from the crown, 1 parts", 0.0f, 1.0f, &S::parted},
    GrowField{"lift", "0 leaves the skin flat, 1 upright", 0.0f, 1.0f, &S::lift},
    GrowField{"stiffness", "0 falls at once, 1 never", 0.0f, 1.0f, &S::stiffness},
    GrowField{"volume", "thickness of the coat, 1 is about a centimetre", 0.0f, 10.0f, &S::volume},
    GrowField{"face", "how much of the face is kept free", 0.0f, 1.5f, &S::face},
};

}  // namespace

GrowSettings preset(GrowStyle style) {
    GrowSettings s{.style = style};
    switch (style) {
        case GrowStyle::kStraight:
            s.frizz = 0.12f;
            break;
        case GrowStyle::kBob:
            s.length = 0.30f;
            s.length_variation = 0.04f;
            s.clumping = 0.2f;
            s.frizz = 0.08f;
            s.taper = 0.4f;
            s.volume = 1.4f;
            break;
        case GrowStyle::kWavy:
            s.points = 32;
            s.clumping = 0.65f;
            s.clump_size = 0.020f;
            s.curl = 0.013f;
            s.curl_period = 0.095f;
            s.volume = 1.5f;
            break;
        case GrowStyle::kCurly:
            s.length = 0.42f;
            s.points = 64;
            s.clumping = 0.75f;
            s.clump_size = 0.018f;
            s.curl = 0.009f;
            s.curl_period = 0.062f;
            s.frizz = 0.35f;
            s.flyaways = 0.05f;
            s.volume = 2.0f;
            s.lift = 0.45f;
            break;
        case GrowStyle::kCoily:
            s.length = 0.15f;
            s.length_variation = 0.12f;
            s.count = 16'000;
            s.points = 80;
            s.width = 0.00011f;
            s.taper = 0.3f;
            s.clumping = 0.45f;
            s.clump_size = 0.007f;
            s.curl = 0.0038f;
            s.curl_period = 0.011f;
            s.frizz = 0.5f;
            s.flyaways = 0.06f;
            s.parted = 0.0f;
            s.lift = 0.95f;
            s.stiffness = 0.9f;
            break;
        case GrowStyle::kPonytail:
            s.length = 0.48f;
            s.points = 28;
            s.length_variation = 0.3f;
            s.frizz = 0.2f;
            s.flyaways = 0.008f;
            s.volume = 0.5f;
            s.parted = 0.0f;
            break;
        case GrowStyle::kBraid:
            s.length = 0.56f;
            s.points = 64;
            s.frizz = 0.08f;
            s.flyaways = 0.01f;
            s.volume = 0.5f;
            s.parted = 0.0f;
            break;
        case GrowStyle::kShort:
            s.length = 0.034f;
            s.length_variation = 0.25f;
            s.count = 32'000;
            s.points = 10;
            s.clumping = 0.3f;
            s.clump_size = 0.006f;
            s.frizz = 0.08f;
            s.flyaways = 0.0f;
            s.lift = 0.38f;
            s.stiffness = 0.55f;
            s.parted = 0.0f;
            s.comb = {0.25f, 0.0f, 1.0f};
            break;
        case GrowStyle::kFur:
            s.length = 0.022f;
            s.length_variation = 0.4f;
            s.count = 30'000;
            s.points = 8;
            s.guides = 1'200;
            s.width = 0.00006f;
            s.taper = 0.9f;
            s.clumping = 0.35f;
            s.clump_size = 0.006f;
            s.frizz = 0.1f;
            s.parted = 0.0f;
            s.lift = 0.42f;
            s.stiffness = 0.8f;
            s.face = 0.0f;
            break;
    }
    return s;
}

std::span<const std::string_view> grow_style_names() {
    return kStyleNames;
}

std::string_view grow_style_name(GrowStyle style) {
    return kStyleNames[static_cast<size_t>(style)];
}

Result<GrowStyle> grow_style(std::string_view name) {
    const auto* found = std::ranges::find(kStyleNames, name);
    if (found != kStyleNames.end()) return static_cast<GrowStyle>(found - kStyleNames.begin());
    return Error{fmt::format("there is no style '{}'", name), "style",
                 fmt::format("one of: {}", fmt::join(kStyleNames, ", "))};
}

std::span<const GrowField> grow_fields() {
    return kFields;
}

Result<void> check(const GrowSettings& settings) {
    for (const GrowField& field : kFields) {
        const float value = settings.*field.value;
        if (value >= field.low && value <= field.high) continue;
        return Error{fmt::format("is {}", value), std::string(field.name),
                     fmt::format("give a number from {} to {}", field.low, field.high)};
    }
    const auto whole = [](uint32_t value, uint32_t low, uint32_t high,
                          const char* name) -> Result<void> {
        if (value >= low && value <= high) return {};
        return Error{fmt::format("is {}", value), name,
                     fmt::format("give a whole number from {} to {}", low, high)};
    };
    if (auto ok = whole(settings.count, 0, kMostStrands, "count"); !ok) return ok;
    if (auto ok = whole(settings.points, 2, kMostStrandPoints, "points"); !ok) return ok;
    if (auto ok = whole(settings.guides, 1, 100'000, "guides"); !ok) return ok;
    const float comb = glm::dot(settings.comb, settings.comb);
    if (!(comb > 1e-12f) || !std::isfinite(comb)) {
        return Error{"has no direction", "comb", "give three numbers, not all zero"};
    }
    return {};
}

GrowSettings scale_to(const GrowSettings& settings, float factor) {
    GrowSettings scaled = settings;
    for (float GrowSettings::*length :
         {&S::length, &S::width, &S::clump_size, &S::curl, &S::curl_period}) {
        scaled.*length *= factor;
    }
    scaled.density /= factor * factor;
    return scaled;
}

}  // namespace vellus::hair
