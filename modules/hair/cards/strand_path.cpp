#include "modules/hair/cards/strand_path.h"

#include <algorithm>

namespace vellus::hair {

glm::vec3 strand_position(const StrandData& strands, size_t strand, float fraction) {
    const auto first = strands.point_parameter.begin() + strands.strand_begin[strand];
    const auto end = strands.point_parameter.begin() + strands.strand_begin[strand + 1];
    const float wanted = std::clamp(fraction, 0.0f, 1.0f) * 65535.0f;
    const auto after = std::clamp(
        std::upper_bound(first, end, wanted,
                         [](float value, uint16_t parameter) { return value < parameter; }),
        first + 1, end - 1);
    const auto point = static_cast<size_t>(after - strands.point_parameter.begin());
    const float low = strands.point_parameter[point - 1];
    const float span = static_cast<float>(strands.point_parameter[point]) - low;
    const float t = span > 0.0f ? std::clamp((wanted - low) / span, 0.0f, 1.0f) : 0.0f;
    return glm::mix(strands.positions[point - 1], strands.positions[point], t);
}

float strand_width(const StrandData& strands, size_t point, float tip_scale) {
    const float parameter = static_cast<float>(strands.point_parameter[point]) / 65535.0f;
    const float width = strands.point_width.empty() ? strands.width : strands.point_width[point];
    return width * glm::mix(1.0f, tip_scale, parameter);
}

}  // namespace vellus::hair
