#include "game_demo/src/windowed.h"

#include "engine/platform/user_folders.h"
#include "engine/platform/window.h"
#include "game_demo/src/session.h"

namespace vellus::demo {

Result<uint32_t> run_windowed(const Options& options) {
    auto window =
        Window::create({.title = "Vellus", .width = options.size[0], .height = options.size[1]});
    if (!window) return window.error();
    auto device = gpu::Device::create(
        {.name = options.device,
         .validation = options.validation,
         .pipeline_cache_folder = cache_folder(),
         .instance_extensions = (*window)->instance_extensions(),
         .create_surface = [&](VkInstance instance, VkSurfaceKHR* surface) {
             return static_cast<VkResult>((*window)->create_surface(instance, surface));
         }});
    if (!device) return device.error();
    {
        Session session(**window, **device, options);
        if (auto done = session.run(); !done) return done.error();
    }
    return (*device)->validation_messages();
}

}  // namespace vellus::demo
