#include "modules/hair/dynamics/guides.h"

#include <algorithm>
#include <cassert>

#include "modules/hair/dynamics/rod.h"

namespace vellus::hair {

namespace {

/// The point `along` metres from the start of a polyline; `at` and `begin` remember the segment.
struct Walk {
    const std::vector<glm::vec3>& points;
    size_t at = 0;
    double begin = 0.0;

    glm::dvec3 point(double along) {
        while (true) {
            const glm::dvec3 a(points[at]);
            const glm::dvec3 b(points[at + 1]);
            const double size = glm::length(b - a);
            if (along <= begin + size || at + 2 >= points.size()) {
                const double t = size > 0.0 ? std::clamp((along - begin) / size, 0.0, 1.0) : 0.0;
                return glm::mix(a, b, t);
            }
            begin += size;
            ++at;
        }
    }
};

double length_of(const std::vector<glm::vec3>& points) {
    double length = 0.0;
    for (size_t i = 1; i < points.size(); ++i) {
        length += glm::length(glm::dvec3(points[i]) - glm::dvec3(points[i - 1]));
    }
    return length;
}

}  // namespace

void GuideColumns::resize(uint32_t components, uint32_t link_count, uint32_t guide_stride) {
    links = link_count;
    stride = guide_stride;
    data.assign(size_t{components} * links * stride, 0.0f);
}

GuideSet make_guides(std::span<const std::vector<glm::vec3>> strands, uint32_t links) {
    assert(links >= 1 && links <= static_cast<uint32_t>(glsl::kRodMaxLinks));
    GuideSet guides;
    guides.count = static_cast<uint32_t>(strands.size());
    guides.links = links;
    guides.stride = (guides.count + kRodLanes - 1) / kRodLanes * kRodLanes;
    guides.rest.resize(3, links, guides.stride);
    guides.preload.resize(3, links, guides.stride);
    guides.root.reserve(guides.count);
    guides.length.reserve(guides.count);
    for (uint32_t g = 0; g < guides.count; ++g) {
        const std::vector<glm::vec3>& points = strands[g];
        assert(points.size() >= 2);
        const double length = length_of(points);
        Walk walk{points};
        glm::dvec3 last(points[0]);
        double sum = 0.0;
        for (uint32_t i = 0; i < links; ++i) {
            const glm::dvec3 next = walk.point(length * (i + 1) / links);
            const glm::vec3 link(next - last);
            for (uint32_t c = 0; c < 3; ++c) guides.rest.at(c, i)[g] = link[static_cast<int>(c)];
            sum += glm::length(link);
            last = next;
        }
        guides.root.push_back(points[0]);
        guides.length.push_back(static_cast<float>(sum));
    }
    return guides;
}

void set_preload(GuideSet& guides, std::span<const glm::vec3> gravity) {
    assert(gravity.size() == guides.count);
    for (uint32_t guide = 0; guide < guides.count; ++guide) {
        const glm::dvec3 g(gravity[guide]);
        glm::dvec3 moment(0.0);
        double mass = 0.0;
        double size_after = 0.0;
        for (uint32_t i = guides.links; i-- > 0;) {
            const glm::dvec3 link(guides.rest.at(0, i)[guide], guides.rest.at(1, i)[guide],
                                  guides.rest.at(2, i)[guide]);
            const double size = glm::length(link);
            mass += 0.5 * (size + size_after);
            moment += glm::cross(link, mass * g);
            for (int c = 0; c < 3; ++c) {
                guides.preload.at(c, i)[guide] = static_cast<float>(moment[c]);
            }
            size_after = size;
        }
    }
}

GuideState rest_state(const GuideSet& guides) {
    GuideState state;
    state.rotation.resize(4, guides.links, guides.stride);
    state.velocity.resize(3, guides.links, guides.stride);
    state.tension.resize(1, guides.links, guides.stride);
    const size_t per_component = size_t{guides.links} * guides.stride;
    std::fill_n(state.rotation.data.begin() + static_cast<ptrdiff_t>(3 * per_component),
                per_component, 1.0f);
    return state;
}

std::vector<glm::vec3> guide_points(const GuideSet& guides, const GuideState& state,
                                    uint32_t guide) {
    std::vector<glm::vec3> points;
    visit_guide_points(guides, state, guide,
                       [&](const glm::vec3& point) { points.push_back(point); });
    return points;
}

}  // namespace vellus::hair
