#include "game_demo/tools/reference/cpu_host.h"

#include <utility>

#include "modules/character/register.h"
#include "modules/hair/binding/bind_hair.h"
#include "modules/hair/dynamics/groom_motion.h"
#include "modules/hair/groom/load_strands.h"
#include "modules/hair/register.h"
#include "modules/hair/spawn.h"
#include "modules/scene/register.h"
#include "modules/scene/time.h"
#include "modules/scene/view.h"

namespace vellus::demo {

Result<std::unique_ptr<CpuHost>> CpuHost::create() {
    std::unique_ptr<CpuHost> host(new CpuHost);
    scene::register_scene(host->world_, host->schedule_);
    character::register_character(host->world_, host->schedule_);
    hair::register_hair_columns(host->world_, host->schedule_);
    if (auto built = host->schedule_.build(host->world_); !built) return built.error();
    return host;
}

void CpuHost::resize(uint32_t width, uint32_t height) {
    world_.resource<scene::ViewSettings>().size = {width, height};
}

Result<void> CpuHost::settle() {
    auto& step = world_.resource<scene::FixedStep>();
    const double dt = std::exchange(step.dt, 0.0);
    schedule_.run(world_);
    step.dt = dt;
    return {};
}

Result<uint32_t> CpuHost::add_groom(const std::filesystem::path& path,
                                    const hair::HairExtension& look) {
    if (const auto known = hair::find_groom(world_, hair::strands_name(path, look.upright))) {
        return *known;
    }
    auto loaded = hair::load_strands(path, look.upright);
    if (!loaded) return loaded.error();
    return add_strands(loaded->name, loaded->strands, loaded->report);
}

uint32_t CpuHost::add_strands(const std::string& name, const hair::StrandData& strands,
                              const hair::GroomReport& report) {
    auto& grooms = world_.resource<hair::HairLibrary>().grooms;
    grooms.push_back(hair::describe_groom(name, strands, report));
    strands_.push_back(strands);
    return static_cast<uint32_t>(grooms.size() - 1);
}

Result<void> CpuHost::bind_hair(Entity hair, Entity mesh) {
    return hair::bind_hair(world_, hair, mesh);
}

Result<void> CpuHost::move_hair(Entity hair, const hair::MotionChoice& motion) {
    hair::add_motion(world_, hair, motion.motion, motion.guides);
    return {};
}

Result<void> CpuHost::set_environment(const light::EnvironmentImage& image) {
    environment_ = image;
    if (image.exposure) world_.resource<scene::ViewSettings>().exposure = *image.exposure;
    return {};
}

void CpuHost::run_to_frame(uint32_t frame) {
    auto& step = world_.resource<scene::FixedStep>();
    for (; step.frame <= frame; ++step.frame) schedule_.run(world_);
}

}  // namespace vellus::demo
