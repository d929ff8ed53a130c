#include "game_demo/src/renderer.h"

#include "engine/frame_graph/context.h"
#include "modules/character/mesh_library.h"
#include "modules/character/register.h"
#include "modules/display/readback.h"
#include "modules/display/register.h"
#include "modules/hair/binding/bind_hair.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "modules/hair/components.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/hair/register.h"
#include "modules/hair/spawn.h"
#include "modules/light/register.h"
#include "modules/scene/library.h"
#include "modules/scene/register.h"
#include "modules/scene/view.h"
#include "modules/temporal/register.h"

namespace vellus::demo {

namespace {

using graph::Access;

constexpr VkImageSubresourceLayers kColorLayer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

void describe_picture(scene::RenderFrame& frame, gpu::Image& target, bool first) {
    const graph::ImageDesc desc{gpu::Format::kRgba8Unorm, frame.size.x, frame.size.y};
    const auto imported = frame.graph.import_image("picture", desc, &target,
                                                   first ? Access::kNone : Access::kTransferRead,
                                                   Access::kTransferRead);
    auto pass = frame.graph.add_pass("demo/picture", graph::PassKind::kTransfer);
    pass.read(frame.display, Access::kTransferRead);
    const auto written = pass.write(imported, Access::kTransferWrite, {}, graph::Load::kDiscard);
    pass.execute(
        [display = frame.display, written, size = frame.size](graph::PassContext& context) {
            const VkImageCopy region{.srcSubresource = kColorLayer,
                                     .dstSubresource = kColorLayer,
                                     .extent = {size.x, size.y, 1}};
            vkCmdCopyImage(context.commands().handle(), context.image(display),
                           VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, context.image(written),
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        });
    frame.graph.output(written);
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(gpu::Device& device,
                                                   const graph::Switches& switches) {
    std::unique_ptr<Renderer> renderer(new Renderer(device));
    auto executor = graph::Executor::create(device, scene::kFramesInFlight);
    if (!executor) return executor.error();
    renderer->executor_ = std::move(*executor);
    renderer->executor_->switches() = switches;
    if (auto done = renderer->register_modules(); !done) return done.error();
    return renderer;
}

Renderer::~Renderer() {
    // What the world holds may still be in use, the picture by a presentation too.
    static_cast<void>(device_.wait_idle());
}

Result<void> Renderer::register_modules() {
    if (auto made = scene::insert_render_frame(world_, device_); !made) return made;
    scene::register_scene(world_, schedule_);
    character::register_character(world_, schedule_);
    light::register_light(world_, schedule_);
    character::register_character_passes(world_, schedule_);
    hair::register_hair(world_, schedule_);
    temporal::register_temporal(world_, schedule_);
    display::register_display(world_, schedule_);
    return schedule_.build(world_);
}

void Renderer::resize(uint32_t width, uint32_t height) {
    auto& view = world_.resource<scene::ViewSettings>();
    if (view.size == glm::uvec2(width, height)) return;
    view.size = {width, height};
    view.cut = true;
}

Result<uint32_t> Renderer::add_groom(const std::filesystem::path& path,
                                     const hair::HairExtension& look) {
    return hair::add_groom(world_, device_, path, look);
}

Result<void> Renderer::move_hair(Entity hair, const hair::MotionChoice& motion) {
    return hair::add_motion(world_, device_, hair, motion.motion, motion.guides);
}

Result<void> Renderer::bind_hair(Entity hair, Entity mesh) {
    return hair::bind_hair(world_, device_, hair, mesh);
}

Result<void> Renderer::add_meshes() {
    return world_.resource<character::MeshLibrary>().update(device_,
                                                            world_.resource<scene::SceneLibrary>());
}

Result<void> Renderer::set_environment(const light::EnvironmentImage& image) {
    return light::use_environment(world_, device_, image);
}

Result<void> Renderer::run_systems() {
    if (auto begun = executor_->begin_frame(); !begun) return begun;
    schedule_.run(world_);
    const auto& error = world_.resource<scene::RenderFrame>().error;
    if (error) return *error;
    return {};
}

Result<void> Renderer::settle() {
    auto& step = world_.resource<scene::FixedStep>();
    const double dt = std::exchange(step.dt, 0.0);
    auto settled = run_systems();
    step.dt = dt;
    world_.resource<scene::ViewSettings>().cut = true;
    return settled;
}

Result<void> Renderer::draw(Output output) {
    if (auto run = run_systems(); !run) return run;
    if (auto described = describe_output(output); !described) return described;
    auto drawn = executor_->execute(world_.resource<scene::RenderFrame>().graph);
    if (!drawn) return drawn;
    world_.resource<scene::ViewSettings>().cut = false;
    ++world_.resource<scene::FixedStep>().frame;
    return {};
}

Result<void> Renderer::describe_output(Output output) {
    auto& frame = world_.resource<scene::RenderFrame>();
    const std::array size{frame.size.x, frame.size.y};
    if (output == Output::kNowhere) {
        frame.graph.output(frame.display);
        return {};
    }
    if (output == Output::kPixels) {
        if (size != readback_size_) {
            if (auto idle = executor_->wait(); !idle) return idle;
            auto made = display::make_readback(device_, frame.size);
            if (!made) return made.error();
            readback_ = std::move(*made);
            readback_size_ = size;
        }
        display::describe_readback(frame, readback_);
        return {};
    }
    if (overlay_) overlay_(frame);
    const bool first =
        size != std::array{picture_.info().width, picture_.info().height} || !picture_;
    if (first) {
        if (auto idle = device_.wait_idle(); !idle) return idle;
        auto made =
            gpu::Image::create(device_, {gpu::Format::kRgba8Unorm, size[0], size[1]}, "picture");
        if (!made) return made.error();
        picture_ = std::move(*made);
    }
    describe_picture(frame, picture_, first);
    return {};
}

Result<void> Renderer::wait() {
    return executor_->wait();
}

asset::Image Renderer::pixels() const {
    return display::read_picture(readback_, {readback_size_[0], readback_size_[1]});
}

std::vector<EffectRow> Renderer::effects() const {
    const auto& library = world_.resource<hair::HairLibrary>();
    std::vector<EffectRow> rows;
    for (const hair::HairEffects& groom : world_.resource<hair::HairFrame>().effects) {
        const std::array reasons = {groom.opacity, groom.shadow, groom.scattering, groom.multiple,
                                    groom.environment};
        for (size_t axis = 0; axis < reasons.size(); ++axis) {
            const std::string_view name = hair::axes()[axis];
            rows.push_back({library.grooms[groom.groom].name, std::string(name),
                            std::string(technique_id(groom.techniques, name)),
                            std::string(text(reasons[axis]))});
        }
        if (groom.motion == hair::MotionReason::kNone) continue;
        rows.push_back({library.grooms[groom.groom].name, "motion",
                        std::string(motion_id(groom.motion, groom.solver)),
                        std::string(text(groom.motion))});
    }
    return rows;
}

std::string Renderer::explain_graph() const {
    return explain(world_.resource<scene::RenderFrame>().graph, executor_->plan());
}

}  // namespace vellus::demo
