#include <fmt/ostream.h>

#include <memory>

#include "game_demo/src/option_values.h"
#include "game_demo/tools/groom/command.h"
#include "game_demo/tools/groom/turntable.h"

namespace vellus::groom_tool {

namespace {

void add_content_options(CLI::App& app, Turntable& turntable) {
    app.add_option("groom", turntable.groom, "The groom: .hair, .tfx, glTF line strips")
        ->required()
        ->type_name("GROOM");
    auto* scene = app.add_option("--scene", turntable.scene, "A glTF scene around it")
                      ->type_name("SCENE.gltf");
    auto* node = app.add_option("--node", turntable.node,
                                "The node that carries it; hair it has is replaced, the look kept")
                     ->needs(scene)
                     ->type_name("NAME");
    app.add_flag("--node-space", turntable.in_node_space,
                 "The groom's coordinates are that node's, not the scene's")
        ->needs(node);
    app.add_flag("--as-is", turntable.as_is, "Do not turn it upright nor into metres")
        ->needs(scene);
    add_numbers(app, "--color", 3, "Linear colour of the hair, each 0 to 1",
                [&turntable](const std::vector<float>& c) {
                    turntable.color = glm::clamp(glm::vec3(c[0], c[1], c[2]), 0.0f, 1.0f);
                })
        ->type_name("R,G,B");
    app.add_option("--tip-scale", turntable.tip_scale, "Share of the width left at the tip")
        ->check(CLI::Range(0.0f, 1.0f))
        ->type_name("N");
}

void add_picture_options(CLI::App& app, Turntable& turntable) {
    app.add_option("--views", turntable.views, "Pictures, evenly around it")
        ->check(CLI::Range(1u, 360u))
        ->type_name("N")
        ->capture_default_str();
    turntable.renderer.size = {640, 480};
    app.add_option_function<std::string>(
           "--size",
           reading("--size",
                   [&turntable](const std::string& text) -> Result<void> {
                       auto size = demo::read_size(text);
                       if (!size) return size.error();
                       turntable.renderer.size = *size;
                       return {};
                   }),
           "Size of each, 640x480 if not given")
        ->type_name("WxH");
    app.add_option("--out", turntable.out, "Folder for view_NN.png")
        ->type_name("DIR")
        ->capture_default_str();
    app.add_flag("--sheet", turntable.sheet, "All of them in DIR/sheet.png as well");
    app.add_option("--pitch", turntable.pitch, "Radians from above")
        ->check(CLI::Range(-1.5, 1.5))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--zoom", turntable.zoom, "Closer by this factor")
        ->check(CLI::Range(0.05, 50.0))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--frames", turntable.frames, "Frames drawn of each view until it is kept")
        ->check(CLI::Range(1u, 1024u))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--device", turntable.renderer.device, "Part of the GPU's name")
        ->type_name("NAME");
    app.add_flag("--validation", turntable.renderer.validation,
                 "Vulkan validation; ends with status 1 if it had anything to say");
}

Action attach(CLI::App& app) {
    auto turntable = std::make_shared<Turntable>();
    add_content_options(app, *turntable);
    add_picture_options(app, *turntable);
    return [turntable](std::ostream& out) -> Result<void> {
        if (auto done = write_turntable(*turntable); !done) return done;
        fmt::print(out, "{} views are in {}\n", turntable->views, turntable->out.string());
        return {};
    };
}

}  // namespace

const Command kView{"view", "Draws turntable pictures of a groom", attach};

}  // namespace vellus::groom_tool
