#include "engine/gpu/pipeline_cache.h"

#include <gtest/gtest.h>

#include <cstring>

#include "engine/gpu/pipeline_library.h"
#include "engine/platform/files.h"
#include "tests/support/own_folder.h"

namespace vellus::gpu {
namespace {

namespace fs = std::filesystem;

class PipelineCacheTest : public testing::Test {
  protected:
    /// One run of a program that makes one pipeline; returns what it found on disk.
    size_t run() {
        auto device = Device::create({.validation = true, .pipeline_cache_folder = folder_});
        EXPECT_TRUE(device);
        EXPECT_TRUE((*device)->pipelines().compute(
            {.shader = "common/clear_words.comp.glsl", .push_bytes = 16}));
        EXPECT_EQ((*device)->validation_messages(), 0u);
        return (*device)->pipeline_cache_loaded();
    }
    fs::path only_file() {
        std::vector<fs::path> files(fs::directory_iterator(folder_), fs::directory_iterator{});
        EXPECT_EQ(files.size(), 1u);
        return files.front();
    }

    test::OwnFolder own_folder_{"pipeline_cache"};
    fs::path folder_ = own_folder_.path() / "made when needed";
};

TEST_F(PipelineCacheTest, TheSecondRunLoadsWhatTheFirstKept) {
    EXPECT_EQ(run(), 0u);
    const auto kept = load_pipeline_cache(only_file());
    // Every driver's data starts with its 32-byte header.
    ASSERT_GE(kept.size(), sizeof(VkPipelineCacheHeaderVersionOne));
    VkPipelineCacheHeaderVersionOne header;
    std::memcpy(&header, kept.data(), sizeof(header));
    EXPECT_EQ(header.headerVersion, VK_PIPELINE_CACHE_HEADER_VERSION_ONE);
    EXPECT_EQ(run(), kept.size());
}

TEST_F(PipelineCacheTest, ADamagedFileIsIgnoredAndReplaced) {
    run();
    auto bytes = *read_file(only_file());
    const auto whole = bytes;
    for (const size_t at : {size_t{0}, size_t{8}, bytes.size() - 1}) {
        bytes = whole;
        bytes[at] ^= std::byte{0x10};
        ASSERT_TRUE(write_file(only_file(), std::span<const std::byte>(bytes)));
        EXPECT_EQ(run(), 0u) << "damaged byte " << at;
        EXPECT_EQ(*read_file(only_file()), whole);
    }
    for (const size_t length : {size_t{0}, size_t{7}, size_t{16}, bytes.size() / 2}) {
        ASSERT_TRUE(write_file(only_file(), std::span<const std::byte>(whole).first(length)));
        EXPECT_EQ(run(), 0u) << "cut to " << length;
    }
}

TEST_F(PipelineCacheTest, AFolderThatCannotBeWrittenIsHarmless) {
    ASSERT_TRUE(write_file(folder_, std::string_view("a file where the folder should be")));
    EXPECT_EQ(run(), 0u);
    EXPECT_EQ(run(), 0u);
}

}  // namespace
}  // namespace vellus::gpu
