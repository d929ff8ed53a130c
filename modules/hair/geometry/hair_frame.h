#pragma once

#include <array>
#include <vector>

#include "engine/ecs/query.h"
#include "engine/ecs/system.h"
#include "engine/gpu/command_buffer.h"
#include "modules/character/components.h"
#include "modules/hair/binding/hair_pose.h"
#include "modules/hair/components.h"
#include "modules/hair/dynamics/components.h"
#include "modules/hair/scattering/fibre_library.h"
#include "modules/light/light_set.h"
#include "modules/scene/bounds.h"
#include "modules/scene/components.h"
#include "modules/scene/pixel_rect.h"
#include "modules/scene/view.h"

namespace vellus::hair {

enum HairFlags : uint32_t { kHasColors = 1 };

/// Mirrors HairInstance of shaders/hair/geometry/instance.glsl, where the fields are explained.
struct HairInstance {
    glm::mat4 to_relative;
    glm::mat4 to_clip;
    glm::mat4 previous_to_clip;
    VkDeviceAddress positions;
    VkDeviceAddress previous_positions;
    VkDeviceAddress parameters;
    VkDeviceAddress colors;
    VkDeviceAddress segment_point;
    VkDeviceAddress segment_strand;
    VkDeviceAddress strand_seed;
    VkDeviceAddress cards;
    VkDeviceAddress ambient;
    uint32_t first_point;
    uint32_t flags;
    glm::vec3 base_color;
    float color_variation;
    glm::vec3 tip_color;
    float gradient_start;
    float specular;
    float roughness;
    float scatter;
    float shift;
    float shadow_falloff;
    float shadow_first;
    float width;
    float ambient_scale;
    std::array<glm::vec3, 3> ambient_axes;
    std::array<glm::vec3, 6> ambient_light;
    uint32_t padding;
};
static_assert(sizeof(HairInstance) == 448);

constexpr uint32_t kNotDeformed = ~0U;

/// A groom whose points this frame are not its rest points: carried by a mesh, or free to be moved.
/// Its points of this frame, and of the last, lie in HairFrame::deformed in metres from `anchor`.
struct HairDeform {
    Entity entity;
    const StrandBuffers* strands = nullptr;
    const BoundGroom* bound = nullptr;  ///< null: its node carries it
    uint32_t pose = kNoPose;            ///< into HairPoses, where bound
    glm::dvec3 anchor{0.0};             ///< world
    glm::mat4x3 node{1.0f};  ///< groom to metres from the anchor, where its node carries it
    glm::mat4x3 previous_node{1.0f};
    VkDeviceAddress points = 0;  ///< packed vec3 by point of the groom; known after kGather
    VkDeviceAddress previous_points = 0;
};

/// What passes need to rasterise one groom.
struct HairDraw {
    const StrandBuffers* strands = nullptr;
    const CardBuffers* cards = nullptr;  ///< null: strands
    uint32_t point_count = 0;            ///< the first of the groom's points are drawn
    VkDeviceAddress positions = 0;       ///< packed vec3; `world` takes them to the world
    uint32_t deform = kNotDeformed;      ///< into HairFrame::deforms
    glm::dmat4 world{1.0};
    glm::mat4 to_clip{1.0f};  ///< jittered
    float width = 0.0f;       ///< metres in the world; 0: from the column
    float tip_scale = 1.0f;
    float scale = 1.0f;  ///< of the width, from groom to world
    float alpha = 1.0f;
    OpacityTechnique opacity = OpacityTechnique::kDither;
    uint32_t first_id = 0;
    uint32_t first_point = 0;
    uint32_t first_card_point = 0;
    uint32_t primitives = 0;  ///< segments, or triangles of cards
    ShadowTechnique shadow = ShadowTechnique::kNone;
    EnvironmentTechnique environment = EnvironmentTechnique::kNone;
    ScatteringTechnique scattering = ScatteringTechnique::kKaris;
    MultipleTechnique multiple = MultipleTechnique::kFakeNormal;
    FibreOptics optics;
    scene::PixelRect rect;
};

/// Why an axis of a groom is drawn the way it is.
enum class EffectReason : uint8_t {
    kChosen,
    kOutOfView,
    kNoShadowingLight,
    kNoEnvironment,
    kNoScatter,
    kTransparent,
    kNoStrands,
};
std::string_view text(EffectReason reason);

/// The effect plan of one groom: what this frame does for it, derived from the world.
struct HairEffects {
    uint32_t groom = 0;
    HairTechniques techniques;
    uint32_t strands = 0;  ///< drawn of the groom's; fewer by HairDetail
    bool drawn = true;
    EffectReason opacity = EffectReason::kChosen;
    EffectReason shadow = EffectReason::kChosen;
    EffectReason scattering = EffectReason::kChosen;
    EffectReason multiple = EffectReason::kChosen;
    EffectReason environment = EffectReason::kChosen;
    MotionReason motion = MotionReason::kNone;
    MotionSolver solver = MotionSolver::kProcessor;
};

/// All hair of this frame. Resource, written by gather_hair.
struct HairFrame {
    std::vector<HairInstance> instances;  ///< visible grooms
    std::vector<HairDraw> draws;          ///< the same grooms
    std::vector<HairDraw> casters;        ///< grooms that shadow, in view or not
    std::vector<HairEffects> effects;     ///< all grooms
    std::vector<HairDeform> deforms;      ///< drawn or casting grooms with points of their own
    float largest_caster = 0.0f;          ///< metres, longest side of the largest caster's box
    uint32_t points = 0;
    uint32_t card_points = 0;
    uint32_t segments = 0;                           ///< and triangles of cards
    std::vector<gpu::UniformSlice> instance_blocks;  ///< uploads of `instances`
    std::vector<gpu::UniformSlice> fibre_blocks;     ///< their fibres, where a technique reads one
    graph::BufferHandle deformed;                    ///< points of `deforms`; invalid without any
    graph::BufferHandle projected;                   ///< of this frame's graph, as the next
    graph::BufferHandle card_vertices;
    graph::BufferHandle layers;      ///< of deep_opacity, all lights; invalid where none looks
    graph::BufferHandle visibility;  ///< closest segment of each pixel
};

/// Hair of its own: the box of an entity with a mesh belongs to the character module, that of bound
/// hair to pose_hair.
using HairBoundsQuery = Query<const Hair, const scene::WorldTransform, scene::WorldBounds,
                              Without<character::MeshSlot>, Without<HairBinding>>;
using HairQuery = Query<Entity, const Hair, const scene::WorldTransform,
                        const scene::PreviousWorldTransform, const scene::WorldBounds,
                        const HairMaterial, const HairWidth, const HairShadow, const HairTechniques,
                        const HairBinding*, const HairMoves*, const HairDetail*, const HairMotion*>;

/// How much denser (above 1) or thinner than in its own width the groom is drawn.
float drawn_thickness(const LibraryGroom& groom, const HairWidth& width, float alpha,
                      const glm::dmat4& world);

/// Whether any of the box may lie inside the picture.
bool in_view(const scene::Box& box, const scene::ViewState& view);

/// System: boxes of hair in the world, widened by a strand.
void update_hair_bounds(HairBoundsQuery hair, Res<const HairLibrary> library);

/// System: hair of alpha 0 takes no room, so that shadow maps fit what shows, as without that hair.
void empty_clear_bounds(Query<const HairMaterial, scene::WorldBounds, With<Hair>> hair);

/// System: which grooms this frame draws, how, and why.
void gather_hair(HairQuery hair, Res<const HairLibrary> library, Res<const HairBindings> bindings,
                 Res<const HairPoses> poses, Res<const scene::ViewState> view,
                 Res<const light::LightSet> lights, Res<HairFrame> frame);

}  // namespace vellus::hair
