#include "modules/hair/geometry/groom_colors.h"

namespace vellus::hair {

RootTipColors root_tip_colors(const LibraryGroom& groom, const HairMaterial& material) {
    if (!material.use_groom_colors || (!groom.has_colors && !groom.color)) {
        return {material.base_color, material.tip_color};
    }
    const glm::vec3 color = groom.color.value_or(glm::vec3(1.0f));
    return {color, color};
}

glm::vec3 mean_color(const LibraryGroom& groom, const HairMaterial& material) {
    if (material.use_groom_colors && groom.mean_color) return *groom.mean_color;
    return 0.5f * (material.base_color + material.tip_color);
}

}  // namespace vellus::hair
