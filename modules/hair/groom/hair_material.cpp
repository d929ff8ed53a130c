#include "modules/hair/groom/hair_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/hair/scattering/melanin.h"

namespace vellus::hair {

namespace {

constexpr float kMostPigment = 100.0f;

/// Moves values into their ranges and keeps one line for each.
class Clamper {
  public:
    void scalar(const char* name, float& value, float low, float high, float fallback) {
        if (value >= low && value <= high) return;
        const float given = value;
        value = std::isnan(value) ? fallback : std::clamp(value, low, high);
        lines_.push_back(
            fmt::format("{} was {}, outside [{}, {}]: {}", name, given, low, high, value));
    }
    void color(const char* name, glm::vec3& value, glm::vec3 fallback) {
        for (int channel = 0; channel < 3; ++channel) {
            scalar(fmt::format("{}[{}]", name, channel).c_str(), value[channel], 0.0f, 1.0f,
                   fallback[channel]);
        }
    }
    std::vector<std::string> take() { return std::move(lines_); }

  private:
    std::vector<std::string> lines_;
};

}  // namespace

glm::vec3 melanin_color(Melanin melanin) {
    return glsl::melanin_base_color(std::clamp(melanin.eumelanin, 0.0f, kMostPigment),
                                    std::clamp(melanin.pheomelanin, 0.0f, kMostPigment));
}

Melanin melanin_from_sliders(float melanin, float redness) {
    const float amount = -std::log(std::max(1.0f - melanin, 1e-4f));
    return {.eumelanin = amount * (1.0f - redness), .pheomelanin = amount * redness};
}

std::vector<std::string> clamp_to_ranges(HairMaterial& material) {
    const HairMaterial fallback;
    // The largest float below one: a gradient that begins at the tip would divide by zero.
    const float below_one = std::nextafter(1.0f, 0.0f);
    Clamper clamper;
    clamper.color("base_color", material.base_color, fallback.base_color);
    clamper.color("tip_color", material.tip_color, fallback.tip_color);
    clamper.scalar("gradient_start", material.gradient_start, 0.0f, below_one,
                   fallback.gradient_start);
    clamper.scalar("color_variation", material.color_variation, 0.0f, 1.0f,
                   fallback.color_variation);
    clamper.scalar("specular", material.specular, 0.0f, 4.0f, fallback.specular);
    clamper.scalar("roughness", material.roughness, 0.0f, 1.0f, fallback.roughness);
    clamper.scalar("scatter", material.scatter, 0.0f, 4.0f, fallback.scatter);
    clamper.scalar("shift", material.shift, -0.2f, 0.2f, fallback.shift);
    clamper.scalar("alpha", material.alpha, 0.0f, 1.0f, fallback.alpha);
    clamper.scalar("eta", material.eta, 1.1f, 3.0f, fallback.eta);
    clamper.scalar("azimuthal", material.azimuthal, 0.5f, 2.0f, fallback.azimuthal);
    return clamper.take();
}

}  // namespace vellus::hair
