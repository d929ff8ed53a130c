#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "game_demo/src/content.h"
#include "game_demo/src/renderer.h"
#include "modules/scene/time.h"
#include "tests/support/gpu_fixture.h"

// A thousand frames of the crowd: strands in motion, cards, nine skins.
namespace vellus::demo {
namespace {

using CrowdSoak = test::GpuTest;

/// What a leak of any kind adds to.
struct Holdings {
    uint64_t resident = 0;       ///< bytes of the process in memory
    uint64_t device_memory = 0;  ///< bytes the device's blocks have given out
    size_t files = 0;            ///< descriptors the process holds
    uint64_t objects = 0;        ///< Vulkan objects the frame graph has made
};

Holdings count(gpu::Device& device, const Renderer& renderer) {
    Holdings held;
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> held.resident;
    held.resident *= static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
    held.device_memory = device.memory().bytes_in_use();
    const std::filesystem::directory_iterator files("/proc/self/fd");
    held.files = static_cast<size_t>(std::distance(begin(files), end(files)));
    held.objects = renderer.objects_created();
    return held;
}

TEST_F(CrowdSoak, AThousandFramesHoldNoMoreThanTheFirstHundred) {
    constexpr int kWarmUp = 100;
    constexpr int kFrames = 1000;
    auto renderer = Renderer::create(device(), {});
    ASSERT_TRUE(renderer) << renderer.error().message();
    Options options;
    options.scene = VELLUS_SOURCE_DIR "/assets/scenes/crowd.gltf";
    options.size = {80, 45};
    ASSERT_TRUE(load_content(**renderer, options));
    (*renderer)->world().resource<scene::FixedStep>().dt = 1.0 / 30.0;
    Holdings warm;
    for (int frame = 0; frame < kFrames; ++frame) {
        const auto drawn = (*renderer)->draw(Output::kPixels);
        ASSERT_TRUE(drawn) << drawn.error().message();
        ASSERT_TRUE((*renderer)->wait());
        if (frame + 1 == kWarmUp) warm = count(device(), **renderer);
    }
    const Holdings end = count(device(), **renderer);
    EXPECT_EQ(end.device_memory, warm.device_memory);
    EXPECT_EQ(end.files, warm.files);
    EXPECT_EQ(end.objects, warm.objects);
    // The C library, the driver and the validation layers keep pages as they please; a hundred
    // bytes leaked in each of its dozens of passes would be 5 MiB. The address sanitizer keeps what
    // is freed, up to 256 MiB, and finds leaks itself.
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(end.resident, warm.resident + (4U << 20U));
#endif
    RecordProperty("resident_growth", std::to_string(static_cast<int64_t>(end.resident) -
                                                     static_cast<int64_t>(warm.resident)));
}

}  // namespace
}  // namespace vellus::demo
