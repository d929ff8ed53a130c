#include "modules/scene/render_frame.h"

#include "engine/frame_graph/context.h"

namespace vellus::scene {

Result<void> insert_render_frame(World& world, gpu::Device& device) {
    // Views, lights and a few thousand hair instances fit well.
    constexpr uint64_t kUploadBytes = 1 << 20;
    auto uploads = gpu::UploadRing::create(device, kUploadBytes, kFramesInFlight);
    if (!uploads) return uploads.error();
    RenderFrame frame;
    frame.device = &device;
    frame.uploads = std::move(*uploads);
    world.insert_resource(std::move(frame));
    return {};
}

void begin_frame(Res<const ViewState> state, Res<RenderFrame> frame) {
    const View& view = state->view;
    frame->graph.reset();
    frame->uploads.begin_frame();
    frame->error.reset();
    frame->size = view.size;
    frame->frame_index = view.frame_index + view.seed;
    frame->pixel_angle = view.pixel_angle;
    frame->view_block = frame->uploads.push_uniform(view);
    frame->view = frame->uploads.address(frame->view_block);
    frame->lights_block = {};
    frame->lights = 0;
    frame->opaque_shadows = {};
    frame->hair_shadows = frame->hair_layers = {};
    frame->hair_pixels = {};
    frame->display = {};

    const auto image = [&](const char* name, gpu::Format format) {
        return frame->graph.create_image(name, {format, view.size.x, view.size.y});
    };
    auto pass = frame->graph.add_pass("scene/clear", graph::PassKind::kRaster);
    frame->color = pass.color(image("color", kColorFormat), graph::clear(0.0f, 0.0f, 0.0f, 1.0f));
    frame->velocity = pass.color(image("velocity", kVelocityFormat), graph::clear(0.0f));
    frame->depth = pass.depth(image("depth", kDepthFormat), graph::clear(0.0f));
    pass.execute([](graph::PassContext&) {});
}

}  // namespace vellus::scene
