#include "modules/light/environment.h"

#include <cmath>

#include "engine/frame_graph/context.h"

namespace vellus::light {

namespace {

struct SkyPush {
    float intensity;
    float rotation_sin;
    float rotation_cos;
    float blur_lod;
};

}  // namespace

Result<Environment> make_environment(gpu::Device& device, const asset::ImageF& equirect,
                                     float intensity, float rotation) {
    auto image = gpu::Image::upload(
        device,
        {.format = gpu::Format::kRgba32Float, .width = equirect.width, .height = equirect.height},
        std::as_bytes(std::span(equirect.rgba)), "environment");
    if (!image) return image.error();
    Environment environment;
    environment.image = std::move(*image);
    environment.radiance = project_sh(equirect);
    environment.intensity = intensity;
    environment.rotation = rotation;
    return environment;
}

void gather_environment(Res<const Environment> environment, Res<LightSet> set) {
    const glsl::Sh9 sh = irradiance_over_pi(
        rotate_about_y(environment->radiance, environment->rotation), environment->intensity);
    std::copy(std::begin(sh.c), std::end(sh.c), set->block.environment.begin());
}

void describe_sky(Res<const Environment> environment, Res<SkyPipeline> sky,
                  Res<scene::RenderFrame> frame) {
    if (!environment->image || !environment->drawn) return;
    if (!frame->raster(sky->pipeline, [] {
            return gpu::RasterInfo{
                .vertex_shader = "light/sky.vert.glsl",
                .fragment_shader = "light/sky.frag.glsl",
                .bindings = {gpu::Binding::kSampledRepeat, gpu::Binding::kUniform},
                .push_bytes = sizeof(SkyPush),
                .color_formats = {gpu::Format::kRgba16Float, gpu::Format::kRg16Float},
                .depth_format = gpu::Format::kD32Float,
                .depth = gpu::DepthMode::kTest};
        })) {
        return;
    }
    auto pass = frame->graph.add_pass("light/sky", graph::PassKind::kRaster);
    frame->color = pass.color(frame->color);
    frame->velocity = pass.color(frame->velocity);
    pass.read(frame->depth, graph::Access::kDepthReadOnly);
    const SkyPush push{environment->intensity, std::sin(environment->rotation),
                       std::cos(environment->rotation), 0.0f};
    pass.execute([push, view = frame->view_block, pipeline = sky->pipeline,
                  image = environment->image.view()](graph::PassContext& context) {
        gpu::CommandBuffer& commands = context.commands();
        commands.bind(*pipeline);
        commands.images({image}, {view});
        commands.push(push);
        commands.draw(3);
    });
}

}  // namespace vellus::light
