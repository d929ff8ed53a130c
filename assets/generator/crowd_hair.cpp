#include <array>

#include "assets/generator/bust.h"
#include "assets/generator/crowd_scene.h"
#include "assets/generator/figure.h"
#include "assets/generator/groom_of.h"
#include "assets/generator/sdf.h"
#include "modules/hair/grow/grow.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;
using hair::GrowSettings;
using hair::GrowStyle;

void append(hair::GrowSurface& surface, const SkinnedPart& part, double (*density)(dvec3)) {
    const auto first = static_cast<uint32_t>(surface.positions.size());
    for (size_t i = 0; i < part.surface.positions.size(); ++i) {
        const dvec3 p = part.surface.positions[i];
        surface.positions.emplace_back(p);
        surface.normals.emplace_back(part.surface.normals[i]);
        surface.density.push_back(static_cast<float>(density(p)));
    }
    for (const uint32_t index : part.surface.indices) {
        surface.triangles.push_back(first + index);
    }
}

/// 1 below hair, 0 on face, ears and neck.
double haired(dvec3 p) {
    const dvec3 b = p - kHeadMiddle;
    return b.y > -0.10 && std::abs(skull_distance(b)) < 0.006
               ? smoothstep(-0.001, 0.005, above_hairline(b))
               : 0.0;
}

/// The settings of a head, counted from the front row's left.
GrowSettings cut_of(size_t person) {
    struct Cut {
        GrowStyle style;
        uint32_t strands, points;
        double length, volume;
    };
    constexpr std::array<Cut, 9> kCuts = {{{GrowStyle::kWavy, 1150, 13, 0.40, 1.3},
                                           {GrowStyle::kCurly, 850, 22, 0.34, 2.0},
                                           {GrowStyle::kStraight, 1300, 10, 0.42, 1.0},
                                           {GrowStyle::kBob, 900, 9, 0.27, 1.3},
                                           {GrowStyle::kPonytail, 900, 11, 0.36, 1.0},
                                           {GrowStyle::kCoily, 1000, 13, 0.13, 2.4},
                                           {GrowStyle::kShort, 1500, 4, 0.045, 1.0},
                                           {GrowStyle::kBraid, 700, 14, 0.50, 1.0},
                                           {GrowStyle::kShort, 1500, 4, 0.075, 1.3}}};
    const Cut& cut = kCuts[person];
    GrowSettings settings = hair::preset(cut.style);
    settings.count = cut.strands;
    settings.points = cut.points;
    settings.length = static_cast<float>(cut.length);
    settings.volume = static_cast<float>(cut.volume);
    settings.parting = person % 2 == 0 ? 0.3F : -0.2F;
    settings.guides = 200;
    settings.flyaways = 0.0F;
    return settings;
}

}  // namespace

Result<std::vector<CrowdGroom>> grow_crowd_hair(const SkinnedPart& skin, const SkinnedPart& shirt) {
    hair::GrowSurface surface;
    append(surface, skin, haired);
    append(surface, shirt, [](dvec3) { return 0.0; });
    surface.mask = [](glm::vec3 p, glm::vec2) { return static_cast<float>(haired(dvec3(p))); };
    std::vector<CrowdGroom> result;
    for (size_t person = 0; person < 9; ++person) {
        const auto grown = hair::grow_groom(surface, cut_of(person), static_cast<uint32_t>(person));
        if (!grown) {
            return grown.error();
        }
        std::vector<Strand> strands;
        for (size_t s = 0; s < grown->strand_count(); ++s) {
            Strand& strand = strands.emplace_back();
            for (uint32_t i = grown->strand_begin[s]; i < grown->strand_begin[s + 1]; ++i) {
                strand.push_back(dvec3(grown->points[i]) - kHeadMiddle);
            }
        }
        result.push_back(
            {"crowd_" + std::to_string(person + 1) + ".hair", to_groom(strands, 0.08F, "Crowd")});
    }
    return result;
}

}  // namespace vellus::sculpt
