#include "assets/generator/groom_of.h"

namespace vellus::sculpt {

hair::Groom to_groom(std::span<const Strand> strands, float thickness, const char* info) {
    hair::Groom groom;
    groom.format = hair::GroomFormat::kHair;
    groom.default_thickness = thickness;
    groom.info = info;
    for (const Strand& strand : strands) {
        for (const glm::dvec3 p : strand) {
            groom.points.emplace_back(glm::dvec3(p.x, -p.z, p.y) * 100.0);
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return groom;
}

}  // namespace vellus::sculpt
