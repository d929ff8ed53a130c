#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/ecs/ecs.h"
#include "engine/gpu/device.h"
#include "modules/hair/binding/hair_pose.h"
#include "modules/hair/components.h"
#include "modules/hair/dynamics/components.h"
#include "modules/hair/dynamics/device_guides.h"
#include "modules/hair/dynamics/guide_motion.h"
#include "modules/hair/dynamics/guide_selection.h"
#include "modules/scene/bounds.h"

namespace vellus::hair {

/// What a groom in motion has on the device.
struct MotionBuffers {
    gpu::Buffer follow;        ///< StrandGuides by strand
    gpu::Buffer strand_begin;  ///< or, of cards, of their rows:
    gpu::Buffer row_begin;
    gpu::Buffer row_points;
    uint32_t row_edge = 0;  ///< CardRows::edge; 0: strands
    gpu::Buffer turns;      ///< kTurnSlots times guide by guide, link by link: four signed 16 bit
};

/// One groom in motion: its guides, who follows them, and what the device gets each frame.
struct GroomMotion {
    explicit GroomMotion(GuideSet guides) : motion(std::move(guides)) {}

    Entity entity;
    GuideMotion motion;
    std::vector<uint32_t> strands;           ///< which strand each guide is
    float spread = 0.0f;                     ///< of GuideSelection
    std::vector<StrandGuides> follow;        ///< by strand, where there are no buffers
    std::unique_ptr<MotionBuffers> buffers;  ///< where there is a device
    uint32_t slot = 0;
    uint32_t previous_slot = 0;
    bool bent = false;  ///< strands differ from where their roots carry them

    std::optional<DeviceGuides> device;  ///< once the device has solved
    bool solve = false;                  ///< it has work this frame

    std::vector<RootPose> roots;  ///< of this frame
    std::vector<WorldCapsule> capsules;
    scene::Box box;  ///< around the strands when they last moved, world
    std::optional<uint64_t> last_frame;
    uint64_t shown_frame = 0;  ///< in which the turns were last drawn with

    [[nodiscard]] uint64_t turn_bytes() const {
        return uint64_t{motion.guides().count} * motion.guides().links * sizeof(glm::uvec2);
    }
};

/// Everything in motion. Resource; entries stay where they are.
struct HairMotions {
    std::vector<std::unique_ptr<GroomMotion>> list;
};

/// Lets the strands of a hair entity move: chooses its guides (0: one strand in 24) and gives it
/// HairMotion and HairMoves, in place of those it has. Bind it first. Of cards, the guides are
/// lines along the middle of some. Errors name the buffer that did not fit.
Result<void> add_motion(World& world, gpu::Device& device, Entity hair,
                        const HairMotion& motion = {}, uint32_t guides = 0);
/// The same of strands in worlds without a device: only the columns, solved on the processor.
void add_motion(World& world, Entity hair, HairMotion motion, uint32_t guides = 0);
/// Strands move rigidly from now on; false where they did before.
bool remove_motion(World& world, Entity hair);

/// Roots of all guides in the world, and the scale from guides to it; false where the groom is
/// mirrored, which no rotation does. `pose` is null for grooms their node carries.
bool place_roots(const BoundRoots* bound, const HairPose* pose, const glm::dmat4& world,
                 GroomMotion& out, double& scale);

/// Calls `visit(link, turn)` for the links of a guide: how each is turned from where its root
/// carries it, in the world.
template <class Visit>
void visit_link_turns(const GroomMotion& groom, uint32_t guide, const Visit& visit) {
    const GuideColumns& rotation = groom.motion.state().rotation;
    const glm::quat root(groom.roots[guide].turn);
    const glm::quat back = glm::conjugate(root);
    for (uint32_t i = 0; i < groom.motion.guides().links; ++i) {
        const glm::quat local(rotation.at(3, i)[guide], rotation.at(0, i)[guide],
                              rotation.at(1, i)[guide], rotation.at(2, i)[guide]);
        visit(i, root * local * back);
    }
}
/// Writes these turns into the next slot, if there is a device, and notes whether any link is
/// turned (`bent`).
void write_turns(GroomMotion& groom);

}  // namespace vellus::hair
