#include "modules/hair/grow/guides.h"

#include <algorithm>
#include <cmath>

#include "modules/hair/grow/chance.h"

// A guide is traced like falling cord: it leaves the skin between its normal and the comb, turns
// towards gravity, and is held off the body and the face.
namespace vellus::hair::grow {

namespace {

using glm::dvec3;

constexpr dvec3 kDown{0.0, -1.0, 0.0};

/// Long hair hangs; the others stand.
bool hangs(GrowStyle style) {
    return style == GrowStyle::kStraight || style == GrowStyle::kBob || style == GrowStyle::kWavy ||
           style == GrowStyle::kCurly;
}

/// How far a strand runs over its neighbours: those from the top lie over those from below.
double layer_of(const Ground& ground, const Root& root, uint32_t key) {
    const double top =
        smoothstep(-0.65, 1.15, (root.position.y - ground.head.center.y) / ground.head.radius);
    const double random_part = random(ground.seed, key, 5);
    const double scale = ground.head.radius / 0.09 * ground.settings.volume;
    return scale * (0.0025 + 0.0095 * top + 0.0055 * random_part);
}

/// Where hair that hangs wants to go at q (in head radii from its middle), `s` radii from the root.
dvec3 hanging_pull(const Ground& ground, const Combed& combed, dvec3 root, dvec3 q, double s,
                   double lock) {
    const double held = 1.0 - smoothstep(0.17, 0.95, s);
    dvec3 pull = combed.direction * (1.1 * held) + kDown * (1.0 - 0.55 * held);
    const double side = combed.from_parting < 0.0 ? -1.0 : 1.0;
    const double beside_face = smoothstep(0.17, 0.55, q.z) * smoothstep(-1.2, 0.0, q.y);
    pull += dvec3(0.22 * side, 0.0, -0.14) * (beside_face * ground.settings.face);
    // Below the chin hair parts before and behind the shoulder, by lock, and hangs together.
    const double low = smoothstep(-0.65, -1.75, q.y);
    const double split = root.z + 0.20 + 0.24 * lock;
    const double away = mix(-1.45, 0.60, saturate(0.5 + split / 0.27));
    pull.z += std::clamp((away - q.z) * 0.9, -0.6, 0.6) * low;
    const double home = 0.70 * std::clamp(combed.from_parting / 0.55, -1.0, 1.0);
    pull.x -= 0.36 * smoothstep(0.0, -1.5, q.y) * (q.x - home);
    if (ground.settings.style == GrowStyle::kBob) {
        // The ends turn in under the jaw.
        const double in = smoothstep(-0.55, -1.15, q.y);
        pull -= unit(dvec3(q.x, 0.0, q.z + 0.25), dvec3(0.0)) * (0.9 * in);
    }
    return unit(pull, kDown);
}

dvec3 standing_pull(const Ground& ground, dvec3 comb_direction) {
    const double weight = ground.settings.style == GrowStyle::kFur ? 0.35 : 0.8;
    return unit(comb_direction + kDown * weight, kDown);
}

/// Where the comb pulls: short hair and fur follow the settings, long hair the head.
Combed comb_at(const Ground& ground, const Root& root) {
    Combed combed = comb(ground.head, ground.settings, root);
    const GrowStyle style = ground.settings.style;
    if (style == GrowStyle::kFur || style == GrowStyle::kShort) {
        const dvec3 wanted = unit(dvec3(ground.settings.comb), dvec3(0.0, 0.0, -1.0));
        const double steady = glm::length(across(wanted, root.normal));
        const dvec3 along =
            across(wanted, root.normal) + across(kDown, root.normal) * (0.3 * (1.0 - steady));
        combed.direction = unit(along, combed.direction);
        if (style == GrowStyle::kShort) {
            // Away from the crown all round, by the comb on top, down at the sides.
            const dvec3 q = (root.position - ground.head.center) / ground.head.radius;
            const dvec3 away = across(q - kCrown, root.normal);
            const dvec3 down = across(kDown, root.normal) * smoothstep(0.95, 0.1, q.y);
            combed.direction = unit(unit(away, along) + down * 0.8 +
                                        combed.direction * (0.4 * smoothstep(0.5, 0.9, q.y)),
                                    combed.direction);
        }
    }
    return combed;
}

/// Cuts the line where it falls below `lowest`.
void trim(Line& line, double lowest) {
    for (size_t i = 2; i < line.size(); ++i) {
        if (line[i].y >= lowest) continue;
        const double t = saturate((line[i - 1].y - lowest) / (line[i - 1].y - line[i].y));
        line[i] = glm::mix(line[i - 1], line[i], std::max(t, 0.05));
        line.resize(i + 1);
        return;
    }
}

Line trace_free(const Ground& ground, const Root& root, uint32_t key, const Combed& combed,
                double length, double layer) {
    const double radius = ground.head.radius;
    const GrowSettings& settings = ground.settings;
    const bool hanging = hangs(settings.style);
    const double step = std::min(0.045 * radius, length / 12.0);
    const double hold = hanging ? 0.0 : settings.stiffness;
    const double rate = 0.16 * std::min(1.0, step / (0.045 * radius) * (hanging ? 1.0 : 2.0));
    const double lock = noise(root.position, 0.39 * radius, ground.seed, 11);
    const dvec3 ruffle = hanging ? dvec3(0.0)
                                 : dvec3(spread(ground.seed, key, 61), spread(ground.seed, key, 62),
                                         spread(ground.seed, key, 63)) *
                                       (0.25 * settings.frizz);
    const dvec3 start = unit(
        root.normal * double{settings.lift} + combed.direction * (1.0 - settings.lift) + ruffle,
        root.normal);
    const double reach = std::max(0.35 * radius, 2.0 * layer);
    dvec3 direction = start;
    dvec3 p = root.position;
    Line line{p};
    double s = 0.0;
    while (s < length) {
        const double stride = std::min(step, length - s + 1e-9 * length);
        const dvec3 pull =
            hanging ? hanging_pull(ground, combed, (root.position - ground.head.center) / radius,
                                   (p - ground.head.center) / radius, s / radius, lock)
                    : standing_pull(ground, combed.direction);
        direction = unit(glm::mix(direction, unit(glm::mix(pull, start, hold), pull), rate), pull);
        dvec3 next = p + direction * stride;
        const double held = layer * smoothstep(0.0, hanging ? 0.61 : 0.3, (s + stride) / radius);
        next = ground.body.push_out(next, held, reach);
        if (hanging && settings.face > 0.0f) {
            next = clear_of_face(ground.head, next,
                                 0.25 * held - (1.0 - settings.face) * 0.7 * radius);
        }
        direction = unit(next - p, direction);
        p += direction * stride;
        line.push_back(p);
        s += step;
    }
    return line;
}

/// Over the scalp to the band.
Line trace_to_band(const Ground& ground, const Root& root, const Gather& gather, double layer) {
    const double radius = ground.head.radius;
    const double step = 0.04 * radius;
    dvec3 p = root.position;
    dvec3 direction = unit(
        root.normal * 0.35 + unit(across(gather.band - p, root.normal), dvec3(0.0)), root.normal);
    Line line{p};
    for (int i = 0; i < 150; ++i) {
        const double far = glm::distance(p, gather.band);
        if (far < 1.5 * step) break;
        const Closest skin = ground.body(p, radius);
        const dvec3 normal = skin.found ? skin.normal : root.normal;
        const double arriving = smoothstep(0.45 * radius, 0.1 * radius, far);
        const dvec3 straight = unit(gather.band - p, direction);
        dvec3 along = unit(across(straight, normal), direction);
        // Where the band lies straight ahead through the head, go round by the top.
        along = unit(glm::mix(along, straight, arriving) + dvec3(0.0, 0.15, 0.0) * (1.0 - arriving),
                     along);
        direction = unit(glm::mix(direction, along, 0.35), along);
        dvec3 next = p + direction * std::min(step, far);
        const double s = static_cast<double>(i + 1) * step / radius;
        next = ground.body.push_out(next, layer * smoothstep(0.0, 0.5, s), radius);
        direction = unit(next - p, direction);
        p += direction * std::min(step, far);
        line.push_back(p);
    }
    line.push_back(gather.band);
    return line;
}

}  // namespace

double length_of(const Line& line) {
    double length = 0.0;
    for (size_t i = 0; i + 1 < line.size(); ++i) length += glm::distance(line[i], line[i + 1]);
    return length;
}

Line resample(const Line& line, size_t count) {
    std::vector<double> along(line.size(), 0.0);
    for (size_t i = 1; i < line.size(); ++i) {
        along[i] = along[i - 1] + glm::distance(line[i - 1], line[i]);
    }
    Line result;
    result.reserve(count);
    size_t segment = 0;
    for (size_t i = 0; i < count; ++i) {
        const double at = along.back() * static_cast<double>(i) / static_cast<double>(count - 1);
        while (segment + 2 < line.size() && along[segment + 1] < at) ++segment;
        const double step = along[segment + 1] - along[segment];
        const double t = step > 0.0 ? saturate((at - along[segment]) / step) : 0.0;
        result.push_back(glm::mix(line[segment], line[segment + 1], t));
    }
    return result;
}

Guide trace_guide(const Ground& ground, const Root& root, uint32_t key,
                  const std::optional<Gather>& gather) {
    const Combed combed = comb_at(ground, root);
    Guide guide{.from_parting = combed.from_parting, .layer = layer_of(ground, root, key)};
    if (gather) {
        guide.line = trace_to_band(ground, root, *gather, guide.layer);
    } else {
        const double radius = ground.head.radius;
        guide.line = trace_free(ground, root, key, combed, ground.settings.length, guide.layer);
        if (ground.settings.style == GrowStyle::kBob) {
            const double wobble = 0.03 * noise(root.position, 0.5 * radius, ground.seed, 13);
            trim(guide.line, ground.head.center.y - (1.22 + wobble) * radius);
        }
    }
    guide.line = resample(guide.line, kGuidePoints);
    guide.length = length_of(guide.line);
    return guide;
}

}  // namespace vellus::hair::grow
