#include "engine/gpu/pipeline_library.h"

#include <algorithm>

#include "engine/gpu/shader_table.h"
#include "engine/platform/log.h"

namespace vellus::gpu {

namespace {

VkSampler make_sampler(VkDevice device, VkFilter filter, VkSamplerAddressMode mode) {
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = filter,
                                   .minFilter = filter,
                                   .mipmapMode = filter == VK_FILTER_LINEAR
                                                     ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                     : VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                   .addressModeU = mode,
                                   .addressModeV = mode,
                                   .addressModeW = mode,
                                   .maxLod = VK_LOD_CLAMP_NONE};
    VkSampler sampler = VK_NULL_HANDLE;
    vkCreateSampler(device, &info, nullptr, &sampler);
    return sampler;
}

/// Specialization constants 0, 1, ... as Vulkan wants them; keeps the storage alive.
struct Specialization {
    explicit Specialization(const std::vector<uint32_t>& constants) {
        for (uint32_t id = 0; id < constants.size(); ++id) entries.push_back({id, id * 4, 4});
        info = {static_cast<uint32_t>(entries.size()), entries.data(), constants.size() * 4,
                constants.data()};
    }
    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};
};

/// A shader module that lives as long as the pipeline is being built.
struct Module {
    VkDevice device;
    VkShaderModule handle;
    ~Module() { vkDestroyShaderModule(device, handle, nullptr); }
};

}  // namespace

VkDescriptorType descriptor_type(Binding binding) {
    switch (binding) {
        case Binding::kStorage:
            return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        case Binding::kUniform:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        default:
            return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
}

PipelineLibrary::PipelineLibrary(Device& device) : device_(device) {
    VkDevice handle = device.handle();
    samplers_ = {make_sampler(handle, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE),
                 make_sampler(handle, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE),
                 make_sampler(handle, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT)};
}

PipelineLibrary::~PipelineLibrary() {
    const auto destroy = [&](auto& table) {
        for (auto& [info, pipeline] : table) {
            vkDestroyPipeline(device_.handle(), pipeline->handle, nullptr);
            vkDestroyPipelineLayout(device_.handle(), pipeline->layout, nullptr);
            vkDestroyDescriptorSetLayout(device_.handle(), pipeline->set_layout, nullptr);
        }
    };
    destroy(compute_);
    destroy(raster_);
    for (VkSampler sampler : samplers_) vkDestroySampler(device_.handle(), sampler, nullptr);
}

void PipelineLibrary::embed(const EmbeddedShader& shader) {
    sources_.try_emplace(std::string(shader.path), shader.words.begin(), shader.words.end());
}

Result<VkShaderModule> PipelineLibrary::module_for(const std::string& path) {
    std::span<const uint32_t> words;
    if (const auto found = sources_.find(path); found != sources_.end()) {
        words = found->second;
    } else {
        const auto table = vellus_shaders();
        const auto row = std::ranges::find(table, path, &EmbeddedShader::path);
        if (row != table.end()) words = row->words;
    }
    if (words.empty()) {
        return Error{"no such shader was built in", path, "is the file below shaders/?"};
    }
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = words.size_bytes(),
                                        .pCode = words.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateShaderModule(device_.handle(), &info, nullptr, &module);
        result != VK_SUCCESS) {
        return vulkan_error(result, path);
    }
    return module;
}

Result<PipelineLibrary::Layouts> PipelineLibrary::make_layouts(const std::vector<Binding>& bindings,
                                                               uint32_t push_bytes,
                                                               VkShaderStageFlags stages,
                                                               const std::string& name) {
    std::vector<VkDescriptorSetLayoutBinding> slots;
    for (uint32_t slot = 0; slot < bindings.size(); ++slot) {
        const VkDescriptorType type = descriptor_type(bindings[slot]);
        const bool sampled = type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        slots.push_back({.binding = slot,
                         .descriptorType = type,
                         .descriptorCount = 1,
                         .stageFlags = stages,
                         .pImmutableSamplers =
                             sampled ? &samplers_[static_cast<size_t>(bindings[slot])] : nullptr});
    }
    const VkDescriptorSetLayoutCreateInfo set{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR,
        .bindingCount = static_cast<uint32_t>(slots.size()),
        .pBindings = slots.data()};
    Layouts layouts;
    if (const VkResult result =
            vkCreateDescriptorSetLayout(device_.handle(), &set, nullptr, &layouts.set);
        result != VK_SUCCESS) {
        return vulkan_error(result, name);
    }
    const VkPushConstantRange range{.stageFlags = stages, .offset = 0, .size = push_bytes};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &layouts.set,
                                          .pushConstantRangeCount = push_bytes > 0 ? 1u : 0u,
                                          .pPushConstantRanges = &range};
    if (const VkResult result =
            vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layouts.pipeline);
        result != VK_SUCCESS) {
        vkDestroyDescriptorSetLayout(device_.handle(), layouts.set, nullptr);
        return vulkan_error(result, name);
    }
    return layouts;
}

Result<VkPipeline> PipelineLibrary::build_compute(const ComputeInfo& info,
                                                  VkPipelineLayout layout) {
    auto made = module_for(info.shader);
    if (!made) return made.error();
    const Module module{device_.handle(), *made};
    const Specialization specialization(info.constants);
    const VkComputePipelineCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module.handle,
                  .pName = "main",
                  .pSpecializationInfo = &specialization.info},
        .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateComputePipelines(device_.handle(), device_.pipeline_cache(),
                                                         1, &create, nullptr, &pipeline);
        result != VK_SUCCESS) {
        return vulkan_error(result, info.shader);
    }
    ++created_;
    device_.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline),
                     info.shader.c_str());
    return pipeline;
}

Result<VkPipeline> PipelineLibrary::build_raster(const RasterInfo& info, VkPipelineLayout layout) {
    auto vertex = module_for(info.vertex_shader);
    if (!vertex) return vertex.error();
    const Module vertex_module{device_.handle(), *vertex};
    Module fragment_module{device_.handle(), VK_NULL_HANDLE};
    if (!info.fragment_shader.empty()) {
        auto fragment = module_for(info.fragment_shader);
        if (!fragment) return fragment.error();
        fragment_module.handle = *fragment;
    }
    const Specialization specialization(info.constants);
    const auto stage = [&](VkShaderStageFlagBits bit, VkShaderModule module) {
        return VkPipelineShaderStageCreateInfo{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = bit,
            .module = module,
            .pName = "main",
            .pSpecializationInfo = &specialization.info};
    };
    const VkPipelineShaderStageCreateInfo stages[] = {
        stage(VK_SHADER_STAGE_VERTEX_BIT, vertex_module.handle),
        stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment_module.handle)};
    const VkPipelineVertexInputStateCreateInfo vertices{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = info.topology};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo rasterization{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = static_cast<VkCullModeFlags>(info.cull_back ? VK_CULL_MODE_BACK_BIT
                                                                : VK_CULL_MODE_NONE),
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo multisample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = info.depth != DepthMode::kNone,
        .depthWriteEnable = info.depth == DepthMode::kTestWrite,
        .depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL};
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(
        info.color_formats.size(), {.blendEnable = info.blend,
                                    .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
                                    .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                    .colorBlendOp = VK_BLEND_OP_ADD,
                                    .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                    .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                    .alphaBlendOp = VK_BLEND_OP_ADD,
                                    .colorWriteMask = 0xf});
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = static_cast<uint32_t>(attachments.size()),
        .pAttachments = attachments.data()};
    const VkDynamicState dynamics[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = dynamics};
    std::vector<VkFormat> formats(info.color_formats.size());
    std::ranges::transform(info.color_formats, formats.begin(), to_vulkan);
    const VkPipelineRenderingCreateInfo rendering{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = static_cast<uint32_t>(formats.size()),
        .pColorAttachmentFormats = formats.data(),
        .depthAttachmentFormat = to_vulkan(info.depth_format)};
    const VkGraphicsPipelineCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = fragment_module.handle ? 2u : 1u,
        .pStages = stages,
        .pVertexInputState = &vertices,
        .pInputAssemblyState = &assembly,
        .pViewportState = &viewport,
        .pRasterizationState = &rasterization,
        .pMultisampleState = &multisample,
        .pDepthStencilState = &depth,
        .pColorBlendState = &blend,
        .pDynamicState = &dynamic,
        .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateGraphicsPipelines(
            device_.handle(), device_.pipeline_cache(), 1, &create, nullptr, &pipeline);
        result != VK_SUCCESS) {
        return vulkan_error(result, info.vertex_shader);
    }
    ++created_;
    device_.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline),
                     info.vertex_shader.c_str());
    return pipeline;
}

Result<const Pipeline*> PipelineLibrary::compute(const ComputeInfo& info) {
    if (const auto found = compute_.find(info); found != compute_.end()) {
        return found->second.get();
    }
    auto layouts =
        make_layouts(info.bindings, info.push_bytes, VK_SHADER_STAGE_COMPUTE_BIT, info.shader);
    if (!layouts) return layouts.error();
    auto pipeline =
        std::make_unique<Pipeline>(Pipeline{.layout = layouts->pipeline,
                                            .set_layout = layouts->set,
                                            .bind_point = VK_PIPELINE_BIND_POINT_COMPUTE,
                                            .bindings = info.bindings,
                                            .push_bytes = info.push_bytes});
    auto& kept = compute_[info] = std::move(pipeline);
    auto built = build_compute(info, kept->layout);
    if (!built) return built.error();
    kept->handle = *built;
    return kept.get();
}

Result<const Pipeline*> PipelineLibrary::raster(const RasterInfo& info) {
    if (const auto found = raster_.find(info); found != raster_.end()) return found->second.get();
    auto layouts =
        make_layouts(info.bindings, info.push_bytes,
                     VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, info.vertex_shader);
    if (!layouts) return layouts.error();
    auto pipeline =
        std::make_unique<Pipeline>(Pipeline{.layout = layouts->pipeline,
                                            .set_layout = layouts->set,
                                            .bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                            .bindings = info.bindings,
                                            .push_bytes = info.push_bytes});
    auto& kept = raster_[info] = std::move(pipeline);
    auto built = build_raster(info, kept->layout);
    if (!built) return built.error();
    kept->handle = *built;
    return kept.get();
}

}  // namespace vellus::gpu
