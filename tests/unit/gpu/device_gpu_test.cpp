#include "engine/gpu/device.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "engine/gpu/features.h"
#include "tests/support/failing_driver.h"
#include "tests/support/gpu_fixture.h"

namespace vellus::gpu {
namespace {

using DeviceTest = test::GpuTest;

TEST_F(DeviceTest, TraitsNameTheDevice) {
    EXPECT_FALSE(device().traits().name.empty());
    EXPECT_GE(device().traits().max_image_side, 4096u);
    const auto names = Device::list();
    ASSERT_TRUE(names);
    EXPECT_NE(std::ranges::find(*names, device().traits().name), names->end());
}

TEST_F(DeviceTest, UnknownNameListsWhatThereIs) {
    const auto none = Device::create({.name = "no such device"});
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message().find(device().traits().name), std::string::npos);
    EXPECT_NE(none.error().message().find("no such device"), std::string::npos);
}

TEST_F(DeviceTest, UploadReadsBack) {
    std::vector<uint32_t> values(100'000);
    std::iota(values.begin(), values.end(), 7u);
    auto buffer = Buffer::upload_span(device(), std::span<const uint32_t>(values), "numbers");
    ASSERT_TRUE(buffer);
    std::vector<uint32_t> back(values.size());
    ASSERT_TRUE(buffer->read_back(device(), std::as_writable_bytes(std::span(back))));
    EXPECT_EQ(values, back);
}

TEST_F(DeviceTest, ComputeWritesThroughADeviceAddress) {
    struct Push {
        VkDeviceAddress words;
        uint32_t count;
        uint32_t value;
    };
    const auto pipeline = device().pipelines().compute(
        {.shader = "common/clear_words.comp.glsl", .push_bytes = sizeof(Push)});
    ASSERT_TRUE(pipeline) << pipeline.error().message();
    const size_t created = device().pipelines().created();

    constexpr uint32_t kCount = 1000;
    const std::vector<uint32_t> ones(kCount + 1, 1);
    auto buffer = Buffer::upload_span(device(), std::span(ones), "words");
    ASSERT_TRUE(buffer);
    ASSERT_TRUE(device().submit_now("clear", [&](VkCommandBuffer handle) {
        CommandBuffer commands(handle);
        commands.bind(**pipeline);
        commands.push(Push{buffer->address(), kCount, 0xabcdu});
        commands.dispatch_threads(kCount, 256);
        EXPECT_EQ(commands.dispatches(), 1u);
    }));
    std::vector<uint32_t> back(kCount + 1);
    ASSERT_TRUE(buffer->read_back(device(), std::as_writable_bytes(std::span(back))));
    EXPECT_EQ(std::ranges::count(back, 0xabcdu), kCount);
    EXPECT_EQ(back[kCount], 1u) << "a thread past the count must not write";

    const auto again = device().pipelines().compute(
        {.shader = "common/clear_words.comp.glsl", .push_bytes = sizeof(Push)});
    EXPECT_EQ(*again, *pipeline);
    EXPECT_EQ(device().pipelines().created(), created) << "the second request must make nothing";
}

TEST_F(DeviceTest, MissingShaderIsNamed) {
    const auto none = device().pipelines().compute({.shader = "no/such.comp.glsl"});
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message().find("no/such.comp.glsl"), std::string::npos);
}

TEST_F(DeviceTest, ImageOfAnImpossibleSizeIsRefused) {
    const uint32_t limit = device().traits().max_image_side;
    const auto image = Image::create(device(), {.width = limit + 1, .height = 1}, "too wide");
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message().find("too wide"), std::string::npos);
    EXPECT_FALSE(Image::create(device(), {.width = 0, .height = 1}, "empty"));
}

TEST_F(DeviceTest, OutOfMemoryNamesTheBufferAndItsSize) {
    if (!test::MemoryLimit::possible()) GTEST_SKIP() << "sanitizers need all the address space";
    if (!device().traits().is_cpu) GTEST_SKIP() << "memory runs out on a CPU device only";
    ASSERT_TRUE(Buffer::create(device(), 16, MemoryKind::kDevice, "small"));
    const test::MemoryLimit limit(256 << 20);
    ASSERT_TRUE(limit.works());
    const auto buffer = Buffer::create(device(), 1 << 30, MemoryKind::kDevice, "all strands");
    ASSERT_FALSE(buffer);
    const std::string message = buffer.error().message();
    EXPECT_NE(message.find("out of device memory"), std::string::npos) << message;
    EXPECT_NE(message.find("all strands (1024.0 MiB)"), std::string::npos) << message;
    EXPECT_TRUE(Buffer::create(device(), 1 << 20, MemoryKind::kDevice, "one strand"));
}

TEST_F(DeviceTest, BufferLargerThanTheDeviceAllowsIsRefused) {
    const uint64_t bytes = device().traits().max_buffer_bytes + 1;
    const auto buffer = Buffer::create(device(), bytes, MemoryKind::kDevice, "too long");
    ASSERT_FALSE(buffer);
    EXPECT_NE(buffer.error().message().find("too long"), std::string::npos);
    EXPECT_NE(buffer.error().message().find(std::to_string(bytes)), std::string::npos);
}

PFN_vkGetPhysicalDeviceFeatures2 real_features;

TEST_F(DeviceTest, MissingFeaturesAreNamed) {
    EXPECT_EQ(missing_features(device().physical(), false), "");
    real_features = vkGetPhysicalDeviceFeatures2;
    const PFN_vkGetPhysicalDeviceFeatures2 poorer = [](VkPhysicalDevice physical,
                                                       VkPhysicalDeviceFeatures2* features) {
        real_features(physical, features);
        features->features.shaderInt64 = VK_FALSE;
        auto* next = static_cast<VkBaseOutStructure*>(features->pNext);
        while (next->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES) {
            next = next->pNext;
        }
        reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(next)->shaderBufferInt64Atomics =
            VK_FALSE;
    };
    const test::Replaced replaced(vkGetPhysicalDeviceFeatures2, poorer);
    EXPECT_EQ(missing_features(device().physical(), false),
              "shaderInt64, shaderBufferInt64Atomics");
}

TEST_F(DeviceTest, ALostDeviceIsNamedWithWhatItWasDoing) {
    const PFN_vkQueueSubmit2 lost = [](VkQueue, uint32_t, const VkSubmitInfo2*, VkFence) {
        return VK_ERROR_DEVICE_LOST;
    };
    const test::Replaced replaced(vkQueueSubmit2, lost);
    const auto done = device().submit_now("strand points", [](VkCommandBuffer) {});
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message().find("device was lost"), std::string::npos);
    EXPECT_NE(done.error().message().find("strand points"), std::string::npos);
}

TEST_F(DeviceTest, FreedMemoryIsUsedAgain) {
    const uint64_t before = device().memory().bytes_in_use();
    for (int round = 0; round < 100; ++round) {
        auto a = Buffer::create(device(), 30 << 20, MemoryKind::kDevice, "a");
        auto b = Buffer::create(device(), 20 << 20, MemoryKind::kDevice, "b");
        auto c = Buffer::create(device(), 100 << 20, MemoryKind::kDevice, "larger than a block");
        ASSERT_TRUE(a && b && c);
        EXPECT_GE(device().memory().bytes_in_use(), before + (150ull << 20));
    }
    EXPECT_EQ(device().memory().bytes_in_use(), before);
}

TEST_F(DeviceTest, BuffersInOneBlockDoNotOverlap) {
    std::vector<Buffer> buffers;
    for (uint32_t i = 0; i < 50; ++i) {
        const std::vector<uint32_t> words(100 + i * 37, i);
        auto buffer = Buffer::upload_span(device(), std::span(words), "piece");
        ASSERT_TRUE(buffer);
        buffers.push_back(std::move(*buffer));
        if (i % 3 == 2) buffers.erase(buffers.begin() + std::ssize(buffers) / 2);
    }
    for (const Buffer& buffer : buffers) {
        std::vector<uint32_t> words(buffer.bytes() / 4);
        ASSERT_TRUE(buffer.read_back(device(), std::as_writable_bytes(std::span(words))));
        EXPECT_EQ(std::ranges::count(words, words[0]), std::ssize(words));
    }
}

}  // namespace
}  // namespace vellus::gpu
