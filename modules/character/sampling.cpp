#include "modules/character/sampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vellus::character {
namespace {

using asset::AnimationChannel;
using asset::AnimationPath;
using asset::Interpolation;

void copy_key(const AnimationChannel& channel, size_t key, std::span<float> out) {
    const bool cubic = channel.interpolation == Interpolation::kCubicSpline;
    const size_t first = cubic ? (3 * key + 1) * channel.width : key * channel.width;
    std::copy_n(channel.values.begin() + static_cast<std::ptrdiff_t>(first), channel.width,
                out.begin());
}

void slerp(const float* from, const float* to, double u, std::span<float> out) {
    const glm::dquat a(from[3], from[0], from[1], from[2]);
    const glm::dquat b(to[3], to[0], to[1], to[2]);
    const glm::dquat q = glm::normalize(glm::slerp(glm::normalize(a), glm::normalize(b), u));
    out[0] = static_cast<float>(q.x);
    out[1] = static_cast<float>(q.y);
    out[2] = static_cast<float>(q.z);
    out[3] = static_cast<float>(q.w);
}

/// Hermite spline of glTF 2.0 appendix C.5; tangents are per second.
void cubic(const AnimationChannel& channel, size_t key, double u, double span,
           std::span<float> out) {
    const size_t width = channel.width;
    const float* const values = channel.values.data() + 3 * key * width;
    const double u2 = u * u;
    const double u3 = u2 * u;
    for (size_t i = 0; i < width; ++i) {
        const double value = values[width + i];
        const double out_tangent = span * values[2 * width + i];
        const double in_tangent = span * values[3 * width + i];
        const double next = values[4 * width + i];
        out[i] =
            static_cast<float>((2 * u3 - 3 * u2 + 1) * value + (u3 - 2 * u2 + u) * out_tangent +
                               (3 * u2 - 2 * u3) * next + (u3 - u2) * in_tangent);
    }
}

void normalize_rotation(std::span<float> out) {
    const glm::dquat q = glm::normalize(glm::dquat(out[3], out[0], out[1], out[2]));
    out[0] = static_cast<float>(q.x);
    out[1] = static_cast<float>(q.y);
    out[2] = static_cast<float>(q.z);
    out[3] = static_cast<float>(q.w);
}

void interpolate(const AnimationChannel& channel, size_t key, double time, std::span<float> out) {
    const double span = static_cast<double>(channel.times[key + 1]) - channel.times[key];
    const double u = span > 0.0 ? (time - channel.times[key]) / span : 0.0;
    const float* const from = channel.values.data() + key * channel.width;
    const float* const to = from + channel.width;
    if (channel.interpolation == Interpolation::kCubicSpline) {
        cubic(channel, key, u, span, out);
    } else if (channel.path == AnimationPath::kRotation) {
        slerp(from, to, u, out);
    } else {
        for (size_t i = 0; i < channel.width; ++i) {
            out[i] = static_cast<float>(from[i] + (static_cast<double>(to[i]) - from[i]) * u);
        }
    }
}

}  // namespace

size_t find_key(std::span<const float> times, double time) {
    const auto above = std::upper_bound(times.begin(), times.end(), time,
                                        [](double t, float key) { return t < key; });
    return above == times.begin() ? 0 : static_cast<size_t>(above - times.begin()) - 1;
}

void sample(const AnimationChannel& channel, double time, std::span<float> out) {
    if (channel.times.empty()) return;
    assert(out.size() >= channel.width);
    const size_t key = find_key(channel.times, time);
    const bool held = time <= channel.times.front() || key + 1 == channel.times.size() ||
                      channel.interpolation == Interpolation::kStep;
    if (held) {
        copy_key(channel, key, out);
    } else {
        interpolate(channel, key, time, out);
    }
    if (channel.path == AnimationPath::kRotation) normalize_rotation(out);
}

double clip_time(double seconds, double duration, bool loop) {
    if (!(duration > 0.0)) return 0.0;
    if (!loop) return std::clamp(seconds, 0.0, duration);
    const double wrapped = seconds - std::floor(seconds / duration) * duration;
    return std::clamp(wrapped, 0.0, duration);
}

}  // namespace vellus::character
