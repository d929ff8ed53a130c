#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/asset/image.h"
#include "engine/ecs/ecs.h"
#include "engine/frame_graph/execute.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/image.h"
#include "game_demo/src/content_host.h"
#include "game_demo/src/stats.h"
#include "modules/scene/render_frame.h"

namespace vellus::demo {

/// Where a finished frame goes.
enum class Output : uint8_t {
    kNowhere,  ///< drawn, but not kept
    kPixels,   ///< to the CPU: pixels()
    kPicture,  ///< to picture(), ready to be presented
};

/// The modules, their world and schedule, and the executor of the frames they describe.
class Renderer final : public ContentHost {
  public:
    static Result<std::unique_ptr<Renderer>> create(gpu::Device& device,
                                                    const graph::Switches& switches);
    ~Renderer() override;

    World& world() override { return world_; }
    /// The systems of a frame; after adding more, build it again.
    Schedule& schedule() { return schedule_; }
    /// Starts histories anew.
    void resize(uint32_t width, uint32_t height) override;
    Result<void> settle() override;
    Result<uint32_t> add_groom(const std::filesystem::path& path,
                               const hair::HairExtension& look) override;
    Result<void> bind_hair(Entity hair, Entity mesh) override;
    Result<void> move_hair(Entity hair, const hair::MotionChoice& motion) override;
    Result<void> add_meshes() override;
    Result<void> set_environment(const light::EnvironmentImage& image) override;
    /// One frame: systems, graph, device. Does not wait for the device.
    Result<void> draw(Output output);
    /// Describes what lies over the picture (panels) in every frame drawn to kPicture.
    void set_overlay(std::function<void(scene::RenderFrame&)> overlay) {
        overlay_ = std::move(overlay);
    }
    /// Waits for all frames; report() is then that of the last one.
    Result<void> wait();

    [[nodiscard]] const graph::FrameReport& report() const { return executor_->report(); }
    /// Vulkan objects the frame graph has made so far; a steady frame makes none.
    [[nodiscard]] uint64_t objects_created() const { return executor_->objects_created(); }
    /// Of the last frame drawn to kPixels, after wait().
    [[nodiscard]] asset::Image pixels() const;
    /// Of the last frame drawn to kPicture; in TRANSFER_SRC_OPTIMAL.
    [[nodiscard]] const gpu::Image& picture() const { return picture_; }
    /// The last frame's effect plan, a line per groom and axis.
    [[nodiscard]] std::vector<EffectRow> effects() const;
    /// The last frame's graph as text: steps, barriers with reasons, memory.
    [[nodiscard]] std::string explain_graph() const;

  private:
    explicit Renderer(gpu::Device& device) : device_(device) {}
    Result<void> register_modules();
    Result<void> run_systems();
    Result<void> describe_output(Output output);

    gpu::Device& device_;
    World world_;
    Schedule schedule_{"frame"};
    bool built_ = false;
    std::unique_ptr<graph::Executor> executor_;
    gpu::Buffer readback_;
    std::array<uint32_t, 2> readback_size_{};
    gpu::Image picture_;
    std::function<void(scene::RenderFrame&)> overlay_;
};

}  // namespace vellus::demo
