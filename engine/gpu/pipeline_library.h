#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/gpu/shader_table.h"

namespace vellus::gpu {

/// How a shader sees the N-th resource of its pass (set 0, binding N); samplers are baked in.
enum class Binding : uint8_t {
    kSampledNearest,  ///< sampler2D, nearest, clamped to the edge
    kSampledLinear,   ///< sampler2D, linear, clamped to the edge
    kSampledRepeat,   ///< sampler2D, linear, repeating
    kStorage,         ///< image2D
    kUniform,         ///< uniform block: small data that all threads read at the same place
};

VkDescriptorType descriptor_type(Binding binding);

struct ComputeInfo {
    std::string shader;  ///< path below shaders/
    std::vector<Binding> bindings;
    uint32_t push_bytes = 0;
    std::vector<uint32_t> constants;  ///< specialization constants 0, 1, ...
    auto operator<=>(const ComputeInfo&) const = default;
};

enum class DepthMode : uint8_t { kNone, kTest, kTestWrite };

struct RasterInfo {
    std::string vertex_shader;
    std::string fragment_shader;  ///< empty: depth only
    std::vector<Binding> bindings;
    uint32_t push_bytes = 0;
    std::vector<uint32_t> constants;
    std::vector<Format> color_formats;
    Format depth_format = Format::kUndefined;
    DepthMode depth = DepthMode::kNone;  ///< reversed Z: greater or equal passes
    bool cull_back = false;
    bool blend = false;  ///< color over what is there by its alpha (not premultiplied)
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto operator<=>(const RasterInfo&) const = default;
};

/// A pipeline and what binding it needs; owned by the library, its address never changes.
struct Pipeline {
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
    std::vector<Binding> bindings;
    uint32_t push_bytes = 0;
};

/// Makes each pipeline once, on first request, and keeps it. In debug builds `reload_changed`
/// recompiles shaders whose files changed and swaps the new pipelines in.
class PipelineLibrary {
  public:
    explicit PipelineLibrary(Device& device);
    ~PipelineLibrary();
    PipelineLibrary(const PipelineLibrary&) = delete;
    PipelineLibrary& operator=(const PipelineLibrary&) = delete;

    /// Errors name the shader. The pointer stays valid as long as the library.
    Result<const Pipeline*> compute(const ComputeInfo& info);
    Result<const Pipeline*> raster(const RasterInfo& info);
    /// Adds a shader from outside shaders/ (vellus_embed_shaders of CMake) under its own path; call
    /// it before a pipeline asks for that path.
    void embed(const EmbeddedShader& shader);
    /// Pipelines made so far: constant in a steady frame.
    [[nodiscard]] size_t created() const { return created_; }
    /// Debug builds: rebuilds pipelines of shaders that changed on disk since the last call; a
    /// shader that no longer compiles keeps its old pipeline and is reported. Returns how many were
    /// rebuilt.
    Result<size_t> reload_changed();
    /// Where reload_changed looks for sources; shaders/ of the source tree unless told.
    void set_source_folder(std::filesystem::path folder);

  private:
    struct Layouts {
        VkDescriptorSetLayout set = VK_NULL_HANDLE;
        VkPipelineLayout pipeline = VK_NULL_HANDLE;
    };

    Result<VkShaderModule> module_for(const std::string& path);
    Result<Layouts> make_layouts(const std::vector<Binding>& bindings, uint32_t push_bytes,
                                 VkShaderStageFlags stages, const std::string& name);
    Result<VkPipeline> build_compute(const ComputeInfo& info, VkPipelineLayout layout);
    Result<VkPipeline> build_raster(const RasterInfo& info, VkPipelineLayout layout);
    template <class Info>
    using Table = std::map<Info, std::unique_ptr<Pipeline>>;

    Device& device_;
    std::array<VkSampler, 3> samplers_{};
    Table<ComputeInfo> compute_;
    Table<RasterInfo> raster_;
    /// SPIR-V that replaces or adds to the embedded table, by shader path.
    std::map<std::string, std::vector<uint32_t>> sources_;
    std::filesystem::path source_folder_;
    std::filesystem::file_time_type newest_source_;
    size_t created_ = 0;
};

}  // namespace vellus::gpu
