#include "modules/hair/grow/gather.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/hair/grow/chance.h"

namespace vellus::hair::grow {

namespace {

using glm::dvec3;

/// Turns of a braid's strand, in head radii of tail.
constexpr double kBraidPeriod = 0.78;
/// Where a braid is tied off, as a share of the tail.
constexpr double kTie = 0.88;

/// A bundle's middle in the cross-section, `turns` along the braid: a figure of eight, so that
/// each passes over one neighbour and under the other.
glm::dvec2 braid_path(double turns) {
    return {wave(turns), 0.55 * wave(2.0 * turns)};
}

}  // namespace

Gather::Frame Gather::at(double s) const {
    const double along = std::max(s, 0.0) / step;
    const size_t last = line.size() - 1;
    const auto i = std::min(static_cast<size_t>(along), last - 1);
    const double t = along - static_cast<double>(i);
    const double inside = std::min(t, 1.0);
    return {glm::mix(line[i], line[i + 1], t),
            unit(glm::mix(left[i], left[i + 1], inside), left[i]),
            unit(glm::mix(back[i], back[i + 1], inside), back[i])};
}

Gather make_gather(const ClosestPoint& body, const Head& head, const GrowSettings& settings) {
    const bool braid = settings.style == GrowStyle::kBraid;
    Gather gather;
    gather.radius =
        head.radius * (braid ? 0.19 : 0.18) * std::sqrt(std::max(settings.volume, 0.1F) * 2.0);
    gather.step = 0.04 * head.radius;
    const dvec3 offset = braid ? dvec3(0.0, -0.38, -1.0) : dvec3(0.0, 0.42, -1.0);
    dvec3 p = body.push_out(head.center + glm::normalize(offset) * head.radius * 0.9,
                            gather.radius * 1.1, head.radius);
    gather.band = p;
    dvec3 direction = glm::normalize(braid ? dvec3(0.0, -0.9, -0.5) : dvec3(0.0, 0.25, -1.0));
    const double rate = braid ? 0.20 : 0.085;
    const auto steps = static_cast<size_t>(settings.length / gather.step) + 2;
    for (size_t i = 0; i < steps; ++i) {
        gather.line.push_back(p);
        direction = glm::normalize(glm::mix(direction, dvec3(0.0, -1.0, -0.06), rate));
        const dvec3 free = p + direction * gather.step;
        const dvec3 held = body.push_out(free, gather.radius * (braid ? 1.7 : 1.35), head.radius);
        direction = unit(held - p, direction);
        p += direction * gather.step;
    }
    for (size_t i = 0; i < steps; ++i) {
        const dvec3 along =
            unit(gather.line[std::min(i + 1, steps - 1)] - gather.line[i == 0 ? 0 : i - 1],
                 dvec3(0.0, -1.0, 0.0));
        gather.left.push_back(unit(across(dvec3(1.0, 0.0, 0.0), along), any_across(along)));
        gather.back.push_back(glm::cross(gather.left.back(), along));
    }
    return gather;
}

dvec3 tail_point(const Gather& gather, const GrowSettings& settings, glm::dvec2 place, double s,
                 double end) {
    const Gather::Frame frame = gather.at(s);
    const double whole = gather.step * static_cast<double>(gather.line.size() - 1);
    const double t = saturate(s / whole);
    if (settings.style != GrowStyle::kBraid) {
        // Tied tight at the band, full below it, thin at the tips.
        const double grown = mix(0.62, 1.45, smoothstep(0.0, 0.30, t)) *
                             mix(1.0, 0.35, smoothstep(0.55, 1.0, s / std::max(end, 1e-6)));
        const glm::dvec2 at = place * gather.radius * grown;
        return frame.position + frame.left * at.x * 1.1 + frame.back * at.y;
    }
    // Each third of the disc is one bundle.
    constexpr std::array<glm::dvec2, 3> kCores = {
        {{1.0, 0.0}, {-0.5, 0.8660254037844386}, {-0.5, -0.8660254037844386}}};
    size_t bundle = 0;
    for (size_t i = 1; i < kCores.size(); ++i) {
        if (glm::dot(place, kCores[i]) > glm::dot(place, kCores[bundle])) bundle = i;
    }
    const glm::dvec2 inside = (place - kCores[bundle] * 0.55) * 1.1;
    const double period = kBraidPeriod * gather.radius / 0.13;
    const double turns = s / period + static_cast<double>(bundle) / 3.0;
    const double tied = smoothstep(kTie, kTie - 0.05, t);
    const double woven = tied * smoothstep(0.0, 0.35 * period, s) * mix(1.0, 0.72, t);
    const double tassel = mix(0.45, 1.0, smoothstep(kTie, kTie + 0.05, t));
    const glm::dvec2 path = braid_path(turns) * 0.92 * woven;
    const glm::dvec2 fill = mix(0.0, 1.0, tied) * inside * 0.85 * mix(1.0, 0.75, t) +
                            (1.0 - tied) * place * 0.75 * tassel;
    const glm::dvec2 at = (path + fill) * gather.radius;
    return frame.position + frame.left * at.x * 1.15 + frame.back * at.y;
}

}  // namespace vellus::hair::grow
