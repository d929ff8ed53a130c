#include "game_demo/src/app.h"

#include <cstdio>

#include "engine/platform/log.h"
#include "engine/platform/user_folders.h"
#include "game_demo/src/headless.h"
#include "game_demo/src/windowed.h"

namespace vellus::demo {

namespace {

Result<void> list_devices() {
    auto names = gpu::Device::list();
    if (!names) return names.error();
    for (const std::string& name : *names) fmt::print("{}\n", name);
    return {};
}

Result<uint32_t> open_headless(const Options& options) {
    auto device = gpu::Device::create({.name = options.device,
                                       .validation = options.validation,
                                       .pipeline_cache_folder = cache_folder()});
    if (!device) return device.error();
    if (auto done = run_headless(**device, options); !done) return done.error();
    return (*device)->validation_messages();
}

}  // namespace

int run(const Options& options) {
    if (options.list_devices) {
        const auto listed = list_devices();
        if (!listed) log_error("{}", listed.error().message());
        return listed ? 0 : 1;
    }
    const auto messages = options.headless ? open_headless(options) : run_windowed(options);
    if (!messages) {
        log_error("{}", messages.error().message());
        return 1;
    }
    if (*messages > 0) log_error("{} validation messages, see above", *messages);
    return *messages == 0 ? 0 : 1;
}

}  // namespace vellus::demo
