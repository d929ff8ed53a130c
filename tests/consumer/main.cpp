#include <cstdio>

#include "engine/asset/image_io.h"
#include "engine/frame_graph/execute.h"
#include "modules/display/readback.h"
#include "modules/display/register.h"
#include "modules/hair/components.h"
#include "modules/hair/register.h"
#include "modules/hair/spawn.h"
#include "modules/light/load_environment.h"
#include "modules/light/register.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"

using namespace vellus;

/// Draws a groom under sun and sky.
Result<void> draw(const char* groom_file, const char* picture_file) {
    auto device = gpu::Device::create({});
    if (!device) return device.error();
    World world;
    Schedule schedule("frame");
    if (auto made = scene::insert_render_frame(world, **device); !made) return made;
    scene::register_scene(world, schedule);
    light::register_light(world, schedule);
    hair::register_hair(world, schedule);
    display::register_display(world, schedule);
    if (auto built = schedule.build(world); !built) return built;

    auto hair = hair::spawn_hair(world, **device, groom_file, {}, kNoEntity);
    if (!hair) return hair.error();
    if (auto sky = light::use_sky(world, **device, {}); !sky) return sky;
    light::spawn_sun(world, {});
    const glm::uvec2 size = world.resource<scene::ViewSettings>().size = {640, 480};
    const auto& outline = world.resource<hair::HairLibrary>().grooms[0].outermost;
    const std::vector<glm::dvec3> points(outline.begin(), outline.end());
    scene::spawn_camera(world, scene::frame_points(points, 0.3, 0.1, 640.0 / 480.0));

    auto executor = graph::Executor::create(**device);
    if (!executor) return executor.error();
    auto picture = display::make_readback(**device, size);
    if (!picture) return picture.error();
    if (auto begun = (*executor)->begin_frame(); !begun) return begun;
    schedule.run(world);
    auto& frame = world.resource<scene::RenderFrame>();
    display::describe_readback(frame, *picture);
    if (auto drawn = (*executor)->execute(frame.graph); !drawn) return drawn;
    if (auto done = (*executor)->wait(); !done) return done;
    return asset::save_png(picture_file, display::read_picture(*picture, size));
}

int main(int argc, char** argv) {
    const auto done = argc == 3 ? draw(argv[1], argv[2]) : Error{"usage: consumer GROOM PICTURE"};
    if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
    return done ? 0 : 1;
}
