#pragma once

#include <memory>
#include <vector>

#include "game_demo/src/content_host.h"
#include "modules/hair/groom/groom_report.h"
#include "modules/hair/groom/strand_data.h"

namespace vellus::demo {

/// Content without a device: the world and the systems that place things, strands and environment
/// as columns.
class CpuHost final : public ContentHost {
  public:
    static Result<std::unique_ptr<CpuHost>> create();

    World& world() override { return world_; }
    void resize(uint32_t width, uint32_t height) override;
    Result<void> settle() override;
    Result<uint32_t> add_groom(const std::filesystem::path& path,
                               const hair::HairExtension& look) override;
    /// Strands that are already in node space and metres: their index in the HairLibrary.
    uint32_t add_strands(const std::string& name, const hair::StrandData& strands,
                         const hair::GroomReport& report);
    Result<void> bind_hair(Entity hair, Entity mesh) override;
    Result<void> move_hair(Entity hair, const hair::MotionChoice& motion) override;
    Result<void> add_meshes() override { return {}; }
    Result<void> set_environment(const light::EnvironmentImage& image) override;

    /// Runs the frames up to this one, as the demo does from its first.
    void run_to_frame(uint32_t frame);

    /// By index in the HairLibrary.
    [[nodiscard]] const hair::StrandData& strands(uint32_t groom) const { return strands_[groom]; }
    [[nodiscard]] const light::EnvironmentImage& environment() const { return environment_; }

  private:
    CpuHost() = default;

    World world_;
    Schedule schedule_{"reference"};
    std::vector<hair::StrandData> strands_;
    light::EnvironmentImage environment_;
};

}  // namespace vellus::demo
