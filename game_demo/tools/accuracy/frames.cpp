#include "game_demo/tools/accuracy/frames.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "engine/frame_graph/context.h"
#include "engine/platform/clock.h"
#include "game_demo/src/accuracy/setting.h"
#include "game_demo/src/renderer.h"
#include "modules/display/readback.h"
#include "modules/hair/spawn.h"
#include "modules/light/environment.h"
#include "modules/scene/time.h"
#include "modules/temporal/temporal.h"

namespace vellus::demo {

namespace {

constexpr const char* kReadback = "display/readback";
constexpr const char* kPicture = "demo/picture";
constexpr uint64_t kPixelBytes = 8;    // of the readback
constexpr uint64_t kPictureBytes = 4;  // of the picture nobody looks at

Radiance unpack(const gpu::Buffer& buffer, uint32_t side) {
    Radiance picture{glm::uvec2(side), std::vector<glm::vec3>(size_t{side} * side)};
    const auto* halves = reinterpret_cast<const uint64_t*>(buffer.mapped());
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        picture.pixels[i] = glm::vec3(glm::unpackHalf4x16(halves[i]));
    }
    return picture;
}

/// The pass' time of the newest frame; one described more than once counts with its sum.
void add_passes(const graph::FrameReport& report, size_t frame, std::vector<PassTimes>& passes) {
    for (PassTimes& pass : passes) pass.ms.push_back(0.0);
    for (const graph::PassReport& pass : report.passes) {
        if (pass.name == kReadback || pass.name == kPicture) continue;
        auto found = std::ranges::find(passes, pass.name, &PassTimes::name);
        if (found == passes.end()) {
            passes.push_back({pass.name, std::vector<double>(frame + 1, 0.0)});
            found = passes.end() - 1;
        }
        found->ms.back() += pass.gpu_ms;
    }
}

Result<void> prepare(Renderer& renderer, gpu::Device& device, const StudioGroom& groom,
                     const FrameRun& run) {
    World& world = renderer.world();
    world.resource<scene::FixedStep>().seed = run.seed;
    const auto add = [&](const StudioGroom& grown) {
        return hair::add_strands(world, device, grown.name, grown.strands, grown.report);
    };
    auto hair = set_up_studio(renderer, add, groom, run.look, run.size);
    if (!hair) return hair.error();
    world.resource<light::Environment>().drawn = false;
    world.resource<temporal::TemporalSettings>() = {run.temporal, run.blend};
    for (const AxisChoice& choice : run.choices) {
        if (auto applied = apply_choice(world, *hair, choice); !applied) return applied;
    }
    return {};
}

}  // namespace

Result<DrawnFrames> draw_frames(gpu::Device& device, const StudioGroom& groom,
                                const FrameRun& run) {
    auto renderer = Renderer::create(device, {});
    if (!renderer) return renderer.error();
    if (auto ready = prepare(**renderer, device, groom, run); !ready) return ready.error();
    const uint64_t pixels = uint64_t{run.size} * run.size;
    auto buffer = gpu::Buffer::create(device, pixels * kPixelBytes, gpu::MemoryKind::kReadback,
                                      "accuracy readback");
    if (!buffer) return buffer.error();
    (*renderer)->set_overlay([&](scene::RenderFrame& frame) {
        display::describe_readback(frame, frame.color, *buffer);
    });
    DrawnFrames drawn;
    for (uint32_t frame = 0; frame < run.warm_up + run.frames; ++frame) {
        const double cpu = process_cpu_seconds();
        if (auto done = (*renderer)->draw(Output::kPicture); !done) return done.error();
        if (auto done = (*renderer)->wait(); !done) return done.error();
        if (frame < run.warm_up) continue;
        drawn.cpu_ms.push_back(1e3 * (process_cpu_seconds() - cpu));
        add_passes((*renderer)->report(), drawn.pictures.size(), drawn.passes);
        drawn.pictures.push_back(unpack(*buffer, run.size));
    }
    const graph::MemoryReport& memory = (*renderer)->report().memory;
    drawn.transient_bytes = memory.transient_bytes;
    drawn.persistent_bytes =
        memory.persistent_bytes -
        std::min(memory.persistent_bytes, pixels * (kPixelBytes + kPictureBytes));
    return drawn;
}

std::vector<double> frame_times(const DrawnFrames& frames) {
    return axis_times(frames, kFrameAxis);
}

bool belongs(std::string_view pass, std::string_view axis) {
    if (axis == kFrameAxis) return true;
    const bool geometry = pass == "hair/project" || pass.starts_with("hair/visibility");
    if (axis == "opacity") return geometry || pass.starts_with("temporal/");
    if (!pass.starts_with("hair/") || geometry) return false;
    const bool shadow = pass.starts_with("hair/shadow") || pass.starts_with("hair/deep");
    return axis == "shadow" || !shadow;
}

std::vector<double> axis_times(const DrawnFrames& frames, std::string_view axis) {
    std::vector<double> sums(frames.pictures.size(), 0.0);
    for (const PassTimes& pass : frames.passes) {
        if (!belongs(pass.name, axis)) continue;
        for (size_t i = 0; i < sums.size(); ++i) sums[i] += pass.ms[i];
    }
    return sums;
}

}  // namespace vellus::demo
