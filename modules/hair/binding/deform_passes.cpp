#include "modules/hair/binding/deform_passes.h"

#include "engine/frame_graph/context.h"
#include "modules/hair/geometry/strand_raster.h"

namespace vellus::hair {

namespace {

using graph::Access;
using graph::PassContext;
using graph::PassKind;

gpu::ComputeInfo compute_info(const char* shader, uint32_t push_bytes) {
    return {.shader = shader, .push_bytes = push_bytes};
}

bool make_pipelines(HairDeformation& made, scene::RenderFrame& frame) {
    if (!made.carries.empty() && !frame.compute(made.carry, [] {
            return compute_info("hair/binding/carry.comp.glsl", sizeof(CarryPush));
        })) {
        return false;
    }
    if (made.skins.empty()) return true;
    return frame.compute(made.skin, [] {
        return compute_info("hair/binding/skin_roots.comp.glsl", sizeof(SkinRootsPush));
    }) && frame.compute(made.deform, [] {
        return compute_info("hair/binding/deform.comp.glsl", sizeof(DeformPush));
    });
}

/// False where the frame's upload memory is used up; the ring has reported that.
bool add_bound(const HairDeform& deform, const HairPose& pose, gpu::UploadRing& uploads,
               uint64_t& vertices, HairDeformation& out) {
    const BoundRoots& roots = deform.bound->roots;
    const BoundRootBuffers& buffers = deform.bound->buffers;
    const auto palette = uploads.push_span(std::span<const glm::mat4x3>(pose.palette));
    const auto weights =
        pose.weights.empty() ? palette : uploads.push_span(std::span<const float>(pose.weights));
    if (palette == 0 || weights == 0) return false;
    const auto vertex_count = static_cast<uint32_t>(roots.vertices.size());
    const uint64_t moved = vertices * kMovedVertexBytes;
    vertices += vertex_count;
    out.skins.push_back({.vertices = buffers.vertices.address(),
                         .morphs = buffers.morphs.address(),
                         .palette = palette,
                         .previous_palette = palette + roots.joint_count * sizeof(glm::mat4x3),
                         .weights = weights,
                         .previous_weights = weights + roots.target_count * sizeof(float),
                         .moved = moved,
                         .vertex_count = vertex_count,
                         .target_count = roots.target_count});
    out.strands.push_back({.roots = buffers.roots.address(),
                           .moved = moved,
                           .local = buffers.local.address(),
                           .points = deform.points,
                           .previous_points = deform.previous_points,
                           .strand_count = static_cast<uint32_t>(roots.roots.size()),
                           .scale = pose.scale[0],
                           .previous_scale = pose.scale[1],
                           .handedness = pose.handedness});
    return true;
}

/// Vertices that carry roots, one groom after the other.
graph::BufferHandle describe_skinning(const HairDeformation& made, uint64_t vertices,
                                      scene::RenderFrame& frame) {
    auto moved = frame.graph.create_buffer("hair root vertices", {vertices * kMovedVertexBytes});
    auto pass = frame.graph.add_pass("hair/skin_roots", PassKind::kCompute);
    moved = pass.write(moved, Access::kStorageWrite, graph::Load::kDiscard);
    pass.execute([skins = std::span<const SkinRootsPush>(made.skins), moved,
                  pipeline = made.skin](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        for (SkinRootsPush push : skins) {
            push.moved += context.address(moved);
            commands.push(push);
            commands.dispatch_threads(push.vertex_count, kStrandGroupSize);
        }
    });
    return moved;
}

void describe_bound(const HairDeformation& made, uint64_t vertices, HairFrame& hair,
                    scene::RenderFrame& frame) {
    const auto moved = describe_skinning(made, vertices, frame);
    auto pass = frame.graph.add_pass("hair/deform", PassKind::kCompute);
    pass.read(moved, Access::kStorageRead);
    hair.deformed = pass.write(hair.deformed, Access::kStorageReadWrite);
    pass.execute([strands = std::span<const DeformPush>(made.strands), moved,
                  pipeline = made.deform](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        for (DeformPush push : strands) {
            push.moved += context.address(moved);
            commands.push(push);
            commands.dispatch_threads(push.strand_count, kStrandGroupSize);
        }
    });
}

void describe_carried(const HairDeformation& made, HairFrame& hair, scene::RenderFrame& frame) {
    auto pass = frame.graph.add_pass("hair/carry", PassKind::kCompute);
    hair.deformed = pass.write(hair.deformed, Access::kStorageReadWrite);
    pass.execute([carries = std::span<const CarryPush>(made.carries),
                  pipeline = made.carry](PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        for (const CarryPush& push : carries) {
            commands.push(push);
            commands.dispatch_threads(push.point_count, kStrandGroupSize);
        }
    });
}

/// Addresses of the deforms' points to all that will read them.
void hand_out(HairFrame& hair) {
    for (HairDraw& caster : hair.casters) {
        if (caster.deform != kNotDeformed) caster.positions = hair.deforms[caster.deform].points;
    }
    for (size_t i = 0; i < hair.draws.size(); ++i) {
        HairDraw& draw = hair.draws[i];
        if (draw.deform == kNotDeformed) continue;
        const HairDeform& deform = hair.deforms[draw.deform];
        draw.positions = hair.instances[i].positions = deform.points;
        hair.instances[i].previous_positions = deform.previous_points;
    }
}

}  // namespace

void assign_hair_points(Res<HairFrame> hair, Res<HairDeformation> deformation,
                        Res<scene::RenderFrame> frame) {
    hair->deformed = {};
    if (hair->deforms.empty()) return;
    uint64_t points = 0;
    for (const HairDeform& deform : hair->deforms) {
        points += 2 * point_stride(deform.strands->point_count);
    }
    gpu::Buffer& buffer = deformation->points;
    if (buffer.bytes() < points * sizeof(glm::vec3)) {
        if (auto idle = frame->device->wait_idle(); !idle) return frame->fail(idle.error());
        auto made = gpu::Buffer::create(*frame->device, points * sizeof(glm::vec3),
                                        gpu::MemoryKind::kDevice, "hair deformed points");
        if (!made) return frame->fail(made.error());
        buffer = *std::move(made);
    }
    VkDeviceAddress next = buffer.address();
    for (HairDeform& deform : hair->deforms) {
        const uint64_t bytes = point_stride(deform.strands->point_count) * sizeof(glm::vec3);
        deform.points = next;
        deform.previous_points = next + bytes;
        next += 2 * bytes;
    }
    hand_out(*hair);
    hair->deformed = frame->graph.import_buffer("hair deformed points", {buffer.bytes()}, &buffer,
                                                Access::kStorageRead);
}

void describe_hair_deformation(Res<HairFrame> hair, Res<const HairPoses> poses,
                               Res<HairDeformation> deformation, Res<scene::RenderFrame> frame) {
    if (hair->deforms.empty() || !hair->deformed) return;
    HairDeformation& made = *deformation;
    made.skins.clear();
    made.strands.clear();
    made.carries.clear();
    uint64_t vertices = 0;
    for (const HairDeform& deform : hair->deforms) {
        if (deform.bound == nullptr) {
            made.carries.push_back({.node = deform.node,
                                    .previous_node = deform.previous_node,
                                    .positions = deform.strands->positions.address(),
                                    .points = deform.points,
                                    .point_count = deform.strands->point_count});
        } else if (!add_bound(deform, poses->list[deform.pose], frame->uploads, vertices, made)) {
            return;
        }
    }
    if (!make_pipelines(made, *frame)) return;
    if (!made.skins.empty()) describe_bound(made, vertices, *hair, *frame);
    if (!made.carries.empty()) describe_carried(made, *hair, *frame);
}

}  // namespace vellus::hair
