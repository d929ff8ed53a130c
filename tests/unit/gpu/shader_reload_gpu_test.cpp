#include <filesystem>
#include <string>

#include "engine/gpu/pipeline_library.h"
#include "engine/platform/files.h"
#include "engine/platform/log.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/own_folder.h"

namespace vellus::gpu {
namespace {

namespace fs = std::filesystem;

/// A copy of shaders/ that a test may edit; every edit is newer than the one before.
class ShaderReloadTest : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
#ifdef NDEBUG
        GTEST_SKIP() << "shaders are reloaded in debug builds only";
#endif
        fs::copy(fs::path(VELLUS_SOURCE_DIR) / "shaders", folder_, fs::copy_options::recursive);
        device().pipelines().set_source_folder(folder_);
    }

    void edit(const std::string& from, const std::string& to) {
        const fs::path file = folder_ / kShader;
        const auto bytes = *read_file(file);
        std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos);
        text.replace(at, from.size(), to);
        const auto before = fs::last_write_time(file);
        ASSERT_TRUE(write_file(file, text));
        fs::last_write_time(file, before + std::chrono::seconds(++edits_));
    }

    /// What the shader writes when told to write 5.
    uint32_t result() {
        struct Push {
            VkDeviceAddress words;
            uint32_t count;
            uint32_t value;
        };
        const auto pipeline =
            device().pipelines().compute({.shader = kShader, .push_bytes = sizeof(Push)});
        auto buffer = Buffer::create(device(), 4, MemoryKind::kReadback, "word");
        EXPECT_TRUE(pipeline && buffer);
        EXPECT_TRUE(device().submit_now("reload test", [&](VkCommandBuffer handle) {
            CommandBuffer commands(handle);
            commands.bind(**pipeline);
            commands.push(Push{buffer->address(), 1, 5});
            commands.dispatch(1);
        }));
        uint32_t value = 0;
        EXPECT_TRUE(buffer->read_back(device(), std::as_writable_bytes(std::span(&value, 1))));
        return value;
    }

    static constexpr const char* kShader = "common/clear_words.comp.glsl";
    test::OwnFolder own_folder_{"shader_reload"};
    fs::path folder_ = own_folder_.path();
    int edits_ = 0;
};

TEST_F(ShaderReloadTest, AChangedFileChangesThePicture) {
    PipelineLibrary& library = device().pipelines();
    EXPECT_EQ(result(), 5u);
    EXPECT_EQ(*library.reload_changed(), 0u) << "the first look only remembers";
    EXPECT_EQ(*library.reload_changed(), 0u) << "nothing changed";
    edit("= value;", "= value + 100u;");
    EXPECT_GE(*library.reload_changed(), 1u);
    EXPECT_EQ(result(), 105u);
    EXPECT_EQ(*library.reload_changed(), 0u);
}

TEST_F(ShaderReloadTest, ABrokenFileKeepsTheOldPipeline) {
    PipelineLibrary& library = device().pipelines();
    const uint32_t before = result();
    ASSERT_TRUE(library.reload_changed());
    std::string logged;
    const LogSink sink =
        set_log_sink([&](LogLevel, std::string_view line) { logged += std::string(line); });
    edit("= value;", "= no_such_name;");
    const auto reloaded = library.reload_changed();
    set_log_sink(sink);
    ASSERT_FALSE(reloaded);
    EXPECT_NE(logged.find(kShader), std::string::npos) << logged;
    EXPECT_EQ(result(), before);
    edit("= no_such_name;", "= value + 7u;");
    EXPECT_TRUE(library.reload_changed());
    EXPECT_EQ(result(), 12u);
}

}  // namespace
}  // namespace vellus::gpu
