#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "engine/gpu/image.h"
#include "engine/platform/clock.h"
#include "engine/platform/files.h"
#include "modules/hair/geometry/strand_raster.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/upright.h"
#include "tests/perf/bench.h"

// Which way of finding the closest visible segment of each pixel is cheapest: hardware lines,
// ribbons, or the compute rasteriser. This is the measurement that chose the rasteriser.
namespace vellus::bench {

namespace {

struct Options {
    std::string groom = "../shared/data/hair/straight.hair";
    std::string device;
    std::string json;
    uint32_t width = 1280;
    uint32_t height = 720;
    int repeats = 9;
};

struct RasterPush {
    VkDeviceAddress projected;
    VkDeviceAddress segment_point;
    glm::vec2 size;
};

struct Row {
    std::string name;
    std::vector<double> cpu_ms;
    uint64_t covered = 0;

    [[nodiscard]] double median() const {
        std::vector<double> sorted = cpu_ms;
        std::ranges::sort(sorted);
        return sorted[sorted.size() / 2];
    }
};

void full_barrier(VkCommandBuffer commands) {
    const VkMemoryBarrier2 barrier{
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .memoryBarrierCount = 1,
                                      .pMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

/// Everything one run needs; the three ways share the projected points.
class Contest {
  public:
    static Result<std::unique_ptr<Contest>> create(const Options& options);
    Result<std::vector<Row>> run();

  private:
    explicit Contest(const Options& options) : options_(options) {}
    Result<void> load();
    Result<void> make_pipelines();
    void record_projection(VkCommandBuffer handle);
    void record_compute(VkCommandBuffer handle);
    void record_hardware(VkCommandBuffer handle, const gpu::Pipeline& pipeline, uint32_t vertices);
    Result<uint64_t> count_compute();
    Result<uint64_t> count_hardware();

    Options options_;
    std::unique_ptr<gpu::Device> device_;
    hair::StrandBuffers strands_;
    float strand_width_ = 0.0f;
    glm::mat4 to_clip_{1.0f};
    float pixels_per_metre_ = 0.0f;
    gpu::Buffer projected_, visibility_;
    gpu::Image ids_, depth_;
    const gpu::Pipeline *project_ = nullptr, *compute_ = nullptr, *lines_ = nullptr,
                        *ribbons_ = nullptr;
};

Result<std::unique_ptr<Contest>> Contest::create(const Options& options) {
    std::unique_ptr<Contest> contest(new Contest(options));
    auto device = gpu::Device::create({.name = options.device});
    if (!device) return device.error();
    contest->device_ = std::move(*device);
    if (auto loaded = contest->load(); !loaded) return loaded.error();
    if (auto made = contest->make_pipelines(); !made) return made.error();
    return contest;
}

Result<void> Contest::load() {
    auto loaded = hair::load_groom(options_.groom);
    if (!loaded) return loaded.error();
    const hair::Upright upright = hair::upright_transform(loaded->groom);
    strand_width_ = static_cast<float>(hair::default_width(loaded->groom, upright.metres_per_unit));
    const auto data = hair::prepare_strands(loaded->groom, upright.to_metres, strand_width_);
    auto strands = hair::StrandBuffers::upload(*device_, data);
    if (!strands) return strands.error();
    strands_ = std::move(*strands);

    const glm::vec3 center = data.bounds.center();
    const float half = 0.5f * data.bounds.size().y;
    constexpr float kFocal = 4.0f;
    const float aspect = static_cast<float>(options_.width) / static_cast<float>(options_.height);
    glm::mat4 projection(0.0f);
    projection[0][0] = kFocal / aspect;
    projection[1][1] = -kFocal;
    projection[2][3] = -1.0f;
    projection[3][2] = 0.05f;
    const glm::vec3 eye = center + glm::vec3(0.0f, 0.0f, half * kFocal * 1.1f);
    to_clip_ = projection * glm::lookAt(eye, center, glm::vec3(0.0f, 1.0f, 0.0f));
    pixels_per_metre_ = 0.5f * static_cast<float>(options_.height) * kFocal;

    const uint64_t pixels = uint64_t{options_.width} * options_.height;
    auto projected =
        gpu::Buffer::create(*device_, strands_.point_count * hair::kProjectedPointBytes,
                            gpu::MemoryKind::kDevice, "projected");
    auto visibility =
        gpu::Buffer::create(*device_, pixels * 8, gpu::MemoryKind::kDevice, "visibility");
    auto ids = gpu::Image::create(
        *device_, {gpu::Format::kR32Uint, options_.width, options_.height, 1, 1}, "ids");
    auto depth = gpu::Image::create(
        *device_, {gpu::Format::kD32Float, options_.width, options_.height, 1, 1}, "depth");
    if (!projected) return projected.error();
    if (!visibility) return visibility.error();
    if (!ids) return ids.error();
    if (!depth) return depth.error();
    projected_ = std::move(*projected);
    visibility_ = std::move(*visibility);
    ids_ = std::move(*ids);
    depth_ = std::move(*depth);
    return {};
}

Result<void> Contest::make_pipelines() {
    gpu::PipelineLibrary& library = device_->pipelines();
    const auto raster = [&](const char* vertex, VkPrimitiveTopology topology) {
        return library.raster({.vertex_shader = vertex,
                               .fragment_shader = "perf/strand_id.frag.glsl",
                               .push_bytes = sizeof(RasterPush),
                               .color_formats = {gpu::Format::kR32Uint},
                               .depth_format = gpu::Format::kD32Float,
                               .depth = gpu::DepthMode::kTestWrite,
                               .topology = topology});
    };
    auto project = library.compute(
        {.shader = "hair/geometry/project.comp.glsl", .push_bytes = sizeof(hair::ProjectPush)});
    auto compute = library.compute({.shader = "hair/geometry/visibility.comp.glsl",
                                    .push_bytes = sizeof(hair::VisibilityPush),
                                    .constants = {0}});
    auto lines = raster("perf/strand_line.vert.glsl", VK_PRIMITIVE_TOPOLOGY_LINE_LIST);
    auto ribbons = raster("perf/strand_ribbon.vert.glsl", VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST);
    for (const auto* made : {&project, &compute, &lines, &ribbons}) {
        if (!*made) return made->error();
    }
    project_ = *project;
    compute_ = *compute;
    lines_ = *lines;
    ribbons_ = *ribbons;
    return {};
}

void Contest::record_projection(VkCommandBuffer handle) {
    gpu::CommandBuffer commands(handle);
    commands.bind(*project_);
    commands.push(hair::ProjectPush{.to_clip = to_clip_,
                                    .positions = strands_.positions.address(),
                                    .parameters = strands_.parameters.address(),
                                    .widths = strands_.widths.address(),
                                    .projected = projected_.address(),
                                    .viewport = {options_.width, options_.height},
                                    .point_count = strands_.point_count,
                                    .width = strand_width_,
                                    .tip_scale = 1.0f,
                                    .pixels_per_metre = pixels_per_metre_});
    commands.dispatch_threads(strands_.point_count, hair::kStrandGroupSize);
    full_barrier(handle);
}

void Contest::record_compute(VkCommandBuffer handle) {
    vkCmdFillBuffer(handle, visibility_.handle(), 0, VK_WHOLE_SIZE, 0);
    record_projection(handle);
    gpu::CommandBuffer commands(handle);
    commands.bind(*compute_);
    commands.push(hair::VisibilityPush{.projected = projected_.address(),
                                       .segment_point = strands_.segment_point.address(),
                                       .segment_strand = strands_.segment_strand.address(),
                                       .strand_seed = strands_.strand_seed.address(),
                                       .target = visibility_.address(),
                                       .size = {options_.width, options_.height},
                                       .segment_count = strands_.segment_count,
                                       .first_id = 0,
                                       .frame = 0,
                                       .alpha = 1.0f});
    commands.dispatch_threads(strands_.segment_count, hair::kStrandGroupSize);
}

void Contest::record_hardware(VkCommandBuffer handle, const gpu::Pipeline& pipeline,
                              uint32_t vertices) {
    record_projection(handle);
    gpu::transition(handle, ids_.handle(), gpu::Format::kR32Uint, VK_IMAGE_LAYOUT_UNDEFINED,
                    VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
    gpu::transition(handle, depth_.handle(), gpu::Format::kD32Float, VK_IMAGE_LAYOUT_UNDEFINED,
                    VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = ids_.view(),
                                          .imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    VkRenderingAttachmentInfo depth = color;
    depth.imageView = depth_.view();
    const VkRect2D area{{0, 0}, {options_.width, options_.height}};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = area,
                               .layerCount = 1,
                               .colorAttachmentCount = 1,
                               .pColorAttachments = &color,
                               .pDepthAttachment = &depth};
    vkCmdBeginRendering(handle, &info);
    const VkViewport viewport{
        0.0f, 0.0f, static_cast<float>(options_.width), static_cast<float>(options_.height),
        0.0f, 1.0f};
    vkCmdSetViewport(handle, 0, 1, &viewport);
    vkCmdSetScissor(handle, 0, 1, &area);
    gpu::CommandBuffer commands(handle);
    commands.bind(pipeline);
    commands.push(RasterPush{
        projected_.address(), strands_.segment_point.address(), {options_.width, options_.height}});
    commands.draw(vertices);
    vkCmdEndRendering(handle);
}

Result<uint64_t> Contest::count_compute() {
    std::vector<uint64_t> words(visibility_.bytes() / 8);
    auto read = visibility_.read_back(*device_, std::as_writable_bytes(std::span(words)));
    if (!read) return read.error();
    return words.size() - static_cast<uint64_t>(std::ranges::count(words, uint64_t{0}));
}

Result<uint64_t> Contest::count_hardware() {
    const uint64_t pixels = uint64_t{options_.width} * options_.height;
    auto buffer = gpu::Buffer::create(*device_, pixels * 4, gpu::MemoryKind::kReadback, "ids");
    if (!buffer) return buffer.error();
    auto copied = device_->submit_now("ids", [&](VkCommandBuffer handle) {
        gpu::transition(handle, ids_.handle(), gpu::Format::kR32Uint,
                        VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {options_.width, options_.height, 1}};
        vkCmdCopyImageToBuffer(handle, ids_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               buffer->handle(), 1, &region);
    });
    if (!copied) return copied.error();
    const std::span words(reinterpret_cast<const uint32_t*>(buffer->mapped()), pixels);
    return pixels - static_cast<uint64_t>(std::ranges::count(words, 0u));
}

Result<std::vector<Row>> Contest::run() {
    std::vector<Row> rows = {
        {.name = "compute rasteriser"}, {.name = "hardware lines"}, {.name = "hardware ribbons"}};
    const std::array<std::function<void(VkCommandBuffer)>, 3> ways = {
        [&](VkCommandBuffer c) { record_compute(c); },
        [&](VkCommandBuffer c) { record_hardware(c, *lines_, strands_.segment_count * 2); },
        [&](VkCommandBuffer c) { record_hardware(c, *ribbons_, strands_.segment_count * 6); }};
    // In turn, so that what else the machine does falls on all of them alike; the first round
    // warms.
    for (int repeat = -1; repeat < options_.repeats; ++repeat) {
        for (size_t way = 0; way < ways.size(); ++way) {
            const double start = process_cpu_seconds();
            auto done = device_->submit_now(rows[way].name.c_str(), ways[way]);
            if (!done) return done.error();
            if (repeat >= 0) {
                rows[way].cpu_ms.push_back((process_cpu_seconds() - start) * 1e3);
                continue;
            }
            auto covered = way == 0 ? count_compute() : count_hardware();
            if (!covered) return covered.error();
            rows[way].covered = *covered;
        }
    }
    return rows;
}

int run_geometry(const Options& options) {
    auto contest = Contest::create(options);
    if (!contest) {
        fmt::print(stderr, "error: {}\n", contest.error().message());
        return 1;
    }
    auto rows = (*contest)->run();
    if (!rows) {
        fmt::print(stderr, "error: {}\n", rows.error().message());
        return 1;
    }
    fmt::print("closest visible segment, {} at {}x{}, CPU time of all threads\n", options.groom,
               options.width, options.height);
    fmt::print("{:<20} {:>10} {:>10} {:>12}\n", "way", "median ms", "x compute", "pixels hit");
    nlohmann::json json = nlohmann::json::array();
    for (const Row& row : *rows) {
        fmt::print("{:<20} {:>10.1f} {:>10.2f} {:>12}\n", row.name, row.median(),
                   row.median() / rows->front().median(), row.covered);
        json.push_back({{"name", row.name}, {"cpu_ms", row.median()}, {"covered", row.covered}});
    }
    if (options.json.empty()) return 0;
    auto written = write_file(options.json, std::string_view(json.dump(2)));
    if (!written) fmt::print(stderr, "error: {}\n", written.error().message());
    return written ? 0 : 1;
}

const Registration kGeometry(
    {"geometry", "closest visible segment: lines, ribbons, compute",
     [](CLI::App& app) -> std::function<int()> {
         auto options = std::make_shared<Options>();
         app.add_option("--groom", options->groom, "groom file");
         app.add_option("--device", options->device, "part of its name");
         app.add_option("--width", options->width, "pixels");
         app.add_option("--height", options->height, "pixels");
         app.add_option("--repeats", options->repeats, "runs to count")->check(CLI::Range(1, 1000));
         app.add_option("--json", options->json, "file for the rows");
         return [options] { return run_geometry(*options); };
     }});

}  // namespace

}  // namespace vellus::bench
