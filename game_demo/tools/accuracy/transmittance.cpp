#include "game_demo/tools/accuracy/transmittance.h"

#include <algorithm>
#include <cassert>

#include "accuracy_shaders.h"
#include "modules/hair/techniques.h"

namespace vellus::demo {

namespace {

/// Only hair reflects no green: ball and background are grey or skin.
bool shows_hair(const glm::vec3& unshadowed) {
    return unshadowed.x > 0.0f && unshadowed.y <= 0.0f;
}

}  // namespace

Result<void> add_transmittance() {
    static const auto added = hair::add_scattering(kTransmittance, gpu::accuracy_shaders().front());
    if (!added) return added.error();
    return {};
}

void to_transmittance(const std::vector<Radiance>& unshadowed, std::vector<Radiance>& frames,
                      std::vector<float>& weight) {
    assert(unshadowed.size() == frames.size());
    for (size_t i = 0; i < weight.size(); ++i) {
        float sum = 0.0f;
        float count = 0.0f;
        for (size_t f = 0; f < frames.size(); ++f) {
            const glm::vec3& all = unshadowed[f].pixels[i];
            if (!shows_hair(all)) continue;
            sum += std::clamp(frames[f].pixels[i].x / all.x, 0.0f, 1.0f);
            count += 1.0f;
        }
        if (count == 0.0f) weight[i] = 0.0f;
        const float mean = count > 0.0f ? sum / count : 1.0f;
        for (size_t f = 0; f < frames.size(); ++f) {
            const glm::vec3& all = unshadowed[f].pixels[i];
            glm::vec3& pixel = frames[f].pixels[i];
            pixel = glm::vec3(shows_hair(all) ? std::clamp(pixel.x / all.x, 0.0f, 1.0f) : mean);
        }
    }
}

}  // namespace vellus::demo
