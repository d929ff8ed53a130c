#include "game_demo/src/accuracy/groom_class.h"

#include <algorithm>
#include <cmath>

namespace vellus::demo {

namespace {

constexpr size_t kSampledStrands = 500;
constexpr double kLongestFur = 0.05;
// Chord over arc, mean over the strands; those grown by modules/hair/grow have .95, .90 and .80.
constexpr double kStraight = 0.93;
constexpr double kWavy = 0.85;

double brightness(const glm::vec3& c) {
    return static_cast<double>(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z);
}

}  // namespace

std::string_view groom_kind(std::span<const glm::vec3> points,
                            std::span<const uint32_t> strand_begin, double metres) {
    if (strand_begin.size() < 2) return "straight";
    const size_t strands = strand_begin.size() - 1;
    double arcs = 0.0;
    double chords = 0.0;
    size_t count = 0;
    for (size_t s = 0; s < strands; s += std::max(strands / kSampledStrands, size_t{1})) {
        const auto strand = points.subspan(strand_begin[s], strand_begin[s + 1] - strand_begin[s]);
        // Straightness within a quarter of the strand: falling hair bends as a whole.
        const size_t step = std::max(strand.size() / 4, size_t{2});
        for (size_t i = 0; i + 1 < strand.size(); i += step) {
            const size_t last = std::min(i + step, strand.size() - 1);
            chords += static_cast<double>(glm::distance(strand[i], strand[last]));
            for (size_t k = i; k < last; ++k) {
                arcs += static_cast<double>(glm::distance(strand[k], strand[k + 1]));
            }
        }
        ++count;
    }
    if (arcs * metres / static_cast<double>(count) < kLongestFur) return "fur";
    const double straightness = chords / arcs;
    return straightness > kStraight ? "straight" : straightness > kWavy ? "wavy" : "curly";
}

std::string_view colour_kind(const glm::vec3& base_color) {
    const auto stops = [](double value) { return std::log2(std::max(value, 1e-4)); };
    const double wanted = stops(brightness(base_color));
    return std::ranges::min_element(
               kHairColours, {},
               [&](const HairColour& known) {
                   return std::abs(stops(brightness(melanin_color(known.melanin))) - wanted);
               })
        ->name;
}

}  // namespace vellus::demo
