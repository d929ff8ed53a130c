#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "engine/gpu/pipeline_library.h"
#include "engine/gpu/shader_table.h"
#include "engine/platform/files.h"
#include "engine/platform/log.h"

extern char** environ;

namespace vellus::gpu {

void PipelineLibrary::set_source_folder(std::filesystem::path folder) {
    source_folder_ = std::move(folder);
    newest_source_ = {};
}

#ifdef NDEBUG

Result<size_t> PipelineLibrary::reload_changed() {
    return size_t{0};
}

#else

namespace {

namespace fs = std::filesystem;

fs::file_time_type newest_below(const fs::path& folder) {
    fs::file_time_type newest = fs::file_time_type::min();
    std::error_code code;
    for (const auto& entry : fs::recursive_directory_iterator(folder, code)) {
        if (entry.is_regular_file(code)) newest = std::max(newest, entry.last_write_time(code));
    }
    return newest;
}

/// Runs glslangValidator as the build does; its messages go to stderr, where the author looks.
Result<std::vector<uint32_t>> compile_shader(const fs::path& folder, const std::string& path) {
    const std::string source = (folder / path).string();
    const std::string output =
        (fs::temp_directory_path() / fmt::format("vellus_reload_{}.spv", ::getpid())).string();
    const std::string include = "-I" + folder.string();
    const std::string stem = path.substr(0, path.rfind('.'));
    const std::string stage = stem.substr(stem.rfind('.') + 1);
    const char* arguments[] = {VELLUS_GLSLANG, "--target-env", "vulkan1.3",    "--quiet",
                               "-S",           stage.c_str(),  "-V",           include.c_str(),
                               "-o",           output.c_str(), source.c_str(), nullptr};
    pid_t child = 0;
    int status = 0;
    if (::posix_spawn(&child, VELLUS_GLSLANG, nullptr, nullptr, const_cast<char**>(arguments),
                      environ) != 0 ||
        ::waitpid(child, &status, 0) != child || status != 0) {
        return Error{"does not compile", source, "see the compiler's messages above"};
    }
    auto bytes = read_file(output);
    fs::remove(output);
    if (!bytes) return bytes.error();
    std::vector<uint32_t> words(bytes->size() / 4);
    std::memcpy(words.data(), bytes->data(), words.size() * 4);
    return words;
}

}  // namespace

Result<size_t> PipelineLibrary::reload_changed() {
    if (source_folder_.empty()) source_folder_ = VELLUS_SHADER_DIR;
    const auto newest = newest_below(source_folder_);
    const bool first_look = newest_source_ == fs::file_time_type{};
    if (newest <= newest_source_ && !first_look) return size_t{0};
    newest_source_ = newest;
    if (first_look) return size_t{0};

    // A header may be included by any shader, so all shaders in use are compiled again.
    std::set<std::string> paths;
    for (const auto& [info, pipeline] : compute_) paths.insert(info.shader);
    for (const auto& [info, pipeline] : raster_) {
        paths.insert(info.vertex_shader);
        if (!info.fragment_shader.empty()) paths.insert(info.fragment_shader);
    }
    // What was embedded from elsewhere has no source here.
    std::erase_if(paths, [&](const std::string& path) {
        return sources_.contains(path) && !fs::exists(source_folder_ / path);
    });
    for (const std::string& path : paths) {
        auto words = compile_shader(source_folder_, path);
        if (!words) {
            log_error("{}", words.error().message());
            return words.error();
        }
        sources_[path] = std::move(*words);
    }
    if (auto idle = device_.wait_idle(); !idle) return idle.error();
    size_t rebuilt = 0;
    const auto replace = [&](Pipeline& pipeline, Result<VkPipeline> built) {
        if (!built) {
            log_error("{}", built.error().message());
            return;
        }
        vkDestroyPipeline(device_.handle(), pipeline.handle, nullptr);
        pipeline.handle = *built;
        ++rebuilt;
    };
    for (auto& [info, pipeline] : compute_)
        replace(*pipeline, build_compute(info, pipeline->layout));
    for (auto& [info, pipeline] : raster_) replace(*pipeline, build_raster(info, pipeline->layout));
    log_info("rebuilt {} pipelines from changed shaders", rebuilt);
    return rebuilt;
}

#endif

}  // namespace vellus::gpu
