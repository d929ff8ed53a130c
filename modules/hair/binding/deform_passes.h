#pragma once

#include <vector>

#include "modules/hair/binding/deform_push.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/scene/render_frame.h"

namespace vellus::hair {

/// Pipelines, memory and this frame's dispatches of deformed grooms; all of it made when the first
/// such groom is drawn. Resource.
struct HairDeformation {
    const gpu::Pipeline* skin = nullptr;
    const gpu::Pipeline* deform = nullptr;
    const gpu::Pipeline* carry = nullptr;
    gpu::Buffer points;
    /// One each per bound groom; `moved` is an offset until the graph says where.
    std::vector<SkinRootsPush> skins;
    std::vector<DeformPush> strands;
    /// One per groom that moves without being bound.
    std::vector<CarryPush> carries;
};

/// Points from the start of one column of points to the next: addresses stay aligned to 16 bytes.
constexpr uint64_t point_stride(uint32_t points) {
    return (uint64_t{points} + 3) & ~uint64_t{3};
}

/// System, stage gather, after gather_hair: memory for this frame's and the last's points of all
/// deforms, and its addresses into deforms, draws, casters and instances.
void assign_hair_points(Res<HairFrame> hair, Res<HairDeformation> deformation,
                        Res<scene::RenderFrame> frame);

/// System, stage strands, before the projection: passes "hair/skin_roots" and "hair/deform" for
/// bound grooms, "hair/carry" for others that move; none where HairFrame::deforms is empty.
void describe_hair_deformation(Res<HairFrame> hair, Res<const HairPoses> poses,
                               Res<HairDeformation> deformation, Res<scene::RenderFrame> frame);

}  // namespace vellus::hair
