#include "modules/hair/grow/fullness.h"

#include <algorithm>
#include <cmath>

#include "modules/hair/grow/chance.h"

namespace vellus::hair::grow {

namespace {

/// Of the density at the parting.
constexpr double kElsewhere = 0.35;

/// Hair that whirls around the crown, or parts; gathered hair and fur are combed one way.
bool falls_apart(GrowStyle style) {
    return style != GrowStyle::kPonytail && style != GrowStyle::kBraid && style != GrowStyle::kFur;
}

}  // namespace

GrowSurface fuller_where_hair_parts(const GrowSurface& surface, const Head& head,
                                    const GrowSettings& settings) {
    GrowSurface fuller = surface;
    if (!falls_apart(settings.style)) return fuller;
    fuller.mask = [mask = surface.mask, head, settings](glm::vec3 position, glm::vec2 uv) {
        const glm::dvec3 q = (glm::dvec3(position) - head.center) / head.radius;
        const double front = smoothstep(-0.60, 0.15, q.z) * smoothstep(0.1, 0.5, q.y);
        const double aside = std::abs(from_parting(head, settings, position));
        const double parting = smoothstep(0.30, 0.05, aside) * front * settings.parted;
        const double crown = smoothstep(0.45, 0.10, glm::distance(q, kCrown));
        const double density = mix(kElsewhere, 1.0, std::max(parting, crown));
        return static_cast<float>(density) * (mask ? mask(position, uv) : 1.0f);
    };
    return fuller;
}

}  // namespace vellus::hair::grow
