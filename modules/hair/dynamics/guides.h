#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

namespace vellus::hair {

/// Links a guide is cut into unless told otherwise; at most kRodMaxLinks (31).
constexpr uint32_t kGuideLinks = 15;

/// A table of floats: component, link, guide; guides fastest and padded to whole lanes.
struct GuideColumns {
    std::vector<float> data;
    uint32_t links = 0;
    uint32_t stride = 0;

    void resize(uint32_t components, uint32_t link_count, uint32_t guide_stride);
    [[nodiscard]] float* at(uint32_t component, uint32_t link) {
        return data.data() + (size_t{component} * links + link) * stride;
    }
    [[nodiscard]] const float* at(uint32_t component, uint32_t link) const {
        return data.data() + (size_t{component} * links + link) * stride;
    }
};

/// Guide strands as groomed, cut into links of equal length; groom space, metres.
struct GuideSet {
    uint32_t count = 0;
    uint32_t links = 0;
    uint32_t stride = 0;          ///< count rounded up to whole lanes
    GuideColumns rest;            ///< x y z of each link
    GuideColumns preload;         ///< moment at each joint that carries the groom's own weight
    std::vector<glm::vec3> root;  ///< by guide
    std::vector<float> length;    ///< by guide; the links' lengths summed
};

/// Cuts each polyline (root to tip, two or more points) into `links` of equal length. A strand
/// without length becomes links of no length, which stay where their root is.
GuideSet make_guides(std::span<const std::vector<glm::vec3>> strands, uint32_t links = kGuideLinks);

/// Sets the preload so that the groom rests as it is under `gravity` (m/s², as each guide's rest is
/// turned): the
/// moment at each joint of the weight beyond it, per unit of mass per length. After J. Hsu et al.,
/// "Sag-Free Initialization for Strand-Based Hybrid Hair Simulation" (SIGGRAPH 2023); a chain that
/// hangs from its root alone has it in closed form.
void set_preload(GuideSet& guides, std::span<const glm::vec3> gravity);

/// Where guides are in their motion.
struct GuideState {
    GuideColumns
        rotation;  ///< quaternion x y z w of each link, from groom space, in its root's frame
    GuideColumns velocity;  ///< of each link's tip end in the world, m/s, in its root's frame
    GuideColumns tension;   ///< force along each link
};

/// As groomed, at rest.
GuideState rest_state(const GuideSet& guides);

/// Calls `visit(point)` for the links + 1 points of a guide, from its root and in its root's frame.
template <class Visit>
void visit_guide_points(const GuideSet& guides, const GuideState& state, uint32_t guide,
                        const Visit& visit) {
    glm::vec3 point(0.0f);
    visit(point);
    for (uint32_t i = 0; i < guides.links; ++i) {
        const glm::quat turn(state.rotation.at(3, i)[guide], state.rotation.at(0, i)[guide],
                             state.rotation.at(1, i)[guide], state.rotation.at(2, i)[guide]);
        point += turn * glm::vec3(guides.rest.at(0, i)[guide], guides.rest.at(1, i)[guide],
                                  guides.rest.at(2, i)[guide]);
        visit(point);
    }
}
/// The same as a list.
std::vector<glm::vec3> guide_points(const GuideSet& guides, const GuideState& state,
                                    uint32_t guide);

}  // namespace vellus::hair
