#include "modules/hair/cards/face_outwards.h"

#include <glm/glm.hpp>

#include "engine/platform/jobs.h"

namespace vellus::hair {

namespace {

/// Places along each ribbon that pull and are pulled.
constexpr uint32_t kPlaces = 8;

constexpr float kLeastSquared = 1e-20f;

/// A piece of a ribbon and how much of it there is.
struct Place {
    glm::vec3 center{0.0f};
    glm::vec3 toward{0.0f};
    float area = 0.0f;
};

Place place_on(const Ribbon& ribbon, float share) {
    const float distance = share * ribbon.length();
    size_t i = 0;
    while (i + 2 < ribbon.rows.size() && ribbon.rows[i + 1].distance < distance) ++i;
    const RibbonRow& a = ribbon.rows[i];
    const RibbonRow& b = ribbon.rows[i + 1];
    const float t = (distance - a.distance) / glm::max(b.distance - a.distance, 1e-12f);
    const float width = glm::mix(a.half_width, b.half_width, t);
    return {glm::mix(a.center, b.center, t), glm::mix(a.toward, b.toward, t),
            width * ribbon.length()};
}

glm::vec3 pull(const Place& at, std::span<const Place> places) {
    glm::vec3 sum(0.0f);
    for (const Place& other : places) {
        const glm::vec3 offset = other.center - at.center;
        // Closer than its own size a place pulls no more, nor does it pull itself.
        const float squared = glm::dot(offset, offset) + 0.1f * other.area + kLeastSquared;
        sum += offset * (other.area / (squared * glm::sqrt(squared)));
    }
    return sum;
}

}  // namespace

void face_outwards(std::span<Ribbon> ribbons) {
    std::vector<Place> places;
    places.reserve(ribbons.size() * kPlaces);
    for (const Ribbon& ribbon : ribbons) {
        for (uint32_t i = 0; i < kPlaces; ++i) {
            places.push_back(place_on(ribbon, (static_cast<float>(i) + 0.5f) / kPlaces));
        }
    }
    parallel_ranges(ribbons.size(), 1, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            float inwards = 0.0f;
            for (uint32_t k = 0; k < kPlaces; ++k) {
                const Place& at = places[i * kPlaces + k];
                inwards += at.area * glm::dot(at.toward, pull(at, places));
            }
            if (inwards <= 0.0f) continue;
            for (RibbonRow& row : ribbons[i].rows) {
                row.across = -row.across;
                row.toward = -row.toward;
            }
        }
    });
}

}  // namespace vellus::hair
