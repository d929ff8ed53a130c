#pragma once

#include <fmt/format.h>

#include <glm/gtc/packing.hpp>

#include "engine/asset/gltf.h"
#include "engine/asset/image_io.h"
#include "engine/frame_graph/context.h"
#include "engine/frame_graph/execute.h"
#include "modules/character/mesh_library.h"
#include "modules/character/register.h"
#include "modules/display/register.h"
#include "modules/hair/cards/add_cards.h"
#include "modules/hair/cards/build_cards.h"
#include "modules/hair/components.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/upright.h"
#include "modules/hair/register.h"
#include "modules/hair/spawn.h"
#include "modules/light/environment.h"
#include "modules/light/load_environment.h"
#include "modules/light/register.h"
#include "modules/scene/camera.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"
#include "modules/scene/render_frame.h"
#include "modules/temporal/register.h"
#include "modules/temporal/temporal.h"

namespace vellus::test {

/// Linear colour of hair over black, the shares of each pixel that show hair and the body that
/// wears it, and what hair would cover without a body; means over frames.
struct CardPicture {
    glm::uvec2 size{0};
    std::vector<glm::vec3> color;
    std::vector<float> coverage;
    std::vector<float> body;
    std::vector<float> alone;

    static CardPicture blank(glm::uvec2 size) {
        const size_t pixels = size_t{size.x} * size.y;
        const std::vector<float> none(pixels, 0.0f);
        return {size, std::vector(pixels, glm::vec3(0.0f)), none, none, none};
    }
};

/// One groom under the default sun and sky, alone or on a body; pictures of it from any side, its
/// dither averaged.
class CardViews {
  public:
    static Result<std::unique_ptr<CardViews>> create(gpu::Device& device, glm::uvec2 size) {
        std::unique_ptr<CardViews> views(new CardViews(device, size));
        if (auto done = views->set_up(); !done) return done.error();
        return views;
    }
    ~CardViews() {
        if (executor_) static_cast<void>(executor_->wait());
    }
    CardViews(const CardViews&) = delete;
    CardViews& operator=(const CardViews&) = delete;

    World& world() { return world_; }
    graph::Executor& executor() { return *executor_; }
    /// The entity that wears the groom.
    [[nodiscard]] Entity hair() const { return hair_; }

    /// Shows another groom of the world's library from now on.
    void show(uint32_t groom) { world_.get<hair::Hair>(hair_)->groom = groom; }

    /// Puts the meshes of a glTF file, without its lights, under the hair, in its upright metres.
    Result<void> wear_on(const std::filesystem::path& file) {
        auto body = asset::load_gltf(file);
        if (!body) return body.error();
        for (asset::Node& node : body->nodes) node.light = asset::kNone;
        auto worn =
            scene::instantiate(world_, std::make_shared<const asset::SceneAsset>(std::move(*body)));
        if (!worn) return worn.error();
        return world_.resource<character::MeshLibrary>().update(
            device_, world_.resource<scene::SceneLibrary>());
    }

    /// From `yaw` radians around, a camera that just frames `points`, moved away `distance` times.
    Result<CardPicture> draw(const std::vector<glm::vec3>& points, double yaw, double distance,
                             int frames) {
        place_camera(points, yaw, distance);
        CardPicture picture = CardPicture::blank(size_);
        const float share = 1.0f / static_cast<float>(frames);
        for (int frame = 0; frame < frames; ++frame) {
            if (auto drawn = draw_frame(); !drawn) return drawn.error();
            const auto* halves = reinterpret_cast<const uint64_t*>(color_.mapped());
            const auto* keys = reinterpret_cast<const uint64_t*>(visibility_.mapped());
            const auto* opaque = reinterpret_cast<const float*>(depth_.mapped());
            for (size_t i = 0; i < picture.color.size(); ++i) {
                const auto hair = std::bit_cast<float>(static_cast<uint32_t>(keys[i] >> 32U));
                if (keys[i] != 0) picture.alone[i] += share;
                if (hair > opaque[i]) {
                    picture.color[i] += share * glm::vec3(glm::unpackHalf4x16(halves[i]));
                    picture.coverage[i] += share;
                } else if (opaque[i] > 0.0f) {
                    picture.body[i] += share;
                }
            }
        }
        return picture;
    }

  private:
    CardViews(gpu::Device& device, glm::uvec2 size) : device_(device), size_(size) {}

    Result<void> set_up() {
        if (auto done = scene::insert_render_frame(world_, device_); !done) return done;
        scene::register_scene(world_, schedule_);
        character::register_character(world_, schedule_);
        light::register_light(world_, schedule_);
        character::register_character_passes(world_, schedule_);
        hair::register_hair(world_, schedule_);
        temporal::register_temporal(world_, schedule_);
        display::register_display(world_, schedule_);
        if (auto sky = light::use_sky(world_, device_, {}); !sky) return sky;
        light::spawn_sun(world_, {});
        world_.resource<scene::ViewSettings>().size = size_;
        world_.resource<temporal::TemporalSettings>().enabled = false;
        camera_ =
            world_.spawn(scene::LocalTransform{}, scene::WorldTransform{},
                         scene::PreviousWorldTransform{}, scene::Camera{}, scene::ActiveCamera{});
        hair::HairExtension look;
        look.material.use_groom_colors = true;
        hair_ = hair::spawn_hair(world_, 0, look, hair::HairTechniques{}, kNoEntity);
        if (auto built = schedule_.build(world_); !built) return built;
        auto executor = graph::Executor::create(device_, scene::kFramesInFlight);
        if (!executor) return executor.error();
        executor_ = std::move(*executor);
        const uint64_t pixels = uint64_t{size_.x} * size_.y;
        for (const auto& [buffer, bytes] :
             {std::pair{&color_, 8}, {&visibility_, 8}, {&depth_, 4}}) {
            auto made = gpu::Buffer::create(device_, pixels * bytes, gpu::MemoryKind::kReadback,
                                            "readback");
            if (!made) return made.error();
            *buffer = std::move(*made);
        }
        return {};
    }

    void place_camera(const std::vector<glm::vec3>& points, double yaw, double distance) {
        std::vector<glm::dvec3> wide(points.begin(), points.end());
        glm::dvec3 low(1e30);
        glm::dvec3 high(-1e30);
        for (const glm::dvec3& p : wide) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const auto pose =
            scene::frame_points(wide, yaw, 0.1, static_cast<double>(size_.x) / size_.y, 0.95);
        auto moved = pose;
        const glm::dvec3 middle = 0.5 * (low + high);
        moved.position = middle + (pose.position - middle) * distance;
        *world_.get<scene::LocalTransform>(camera_) = scene::local_transform(moved);
        *world_.get<scene::Camera>(camera_) = {moved.vertical_fov, moved.near_plane};
    }

    Result<void> draw_frame() {
        if (auto begun = executor_->begin_frame(); !begun) return begun;
        schedule_.run(world_);
        auto& frame = world_.resource<scene::RenderFrame>();
        if (frame.error) return *frame.error;
        const auto visibility = world_.resource<hair::HairFrame>().visibility;
        auto pass = frame.graph.add_pass("test/readback", graph::PassKind::kTransfer);
        const auto into = [&](gpu::Buffer& buffer) {
            auto imported =
                frame.graph.import_buffer("readback", {buffer.bytes()}, &buffer,
                                          graph::Access::kNone, graph::Access::kHostRead);
            imported = pass.write(imported, graph::Access::kTransferWrite, graph::Load::kDiscard);
            frame.graph.output(imported);
            return imported;
        };
        const auto color = into(color_);
        const auto keys = into(visibility_);
        const auto depth = into(depth_);
        pass.read(frame.color, graph::Access::kTransferRead);
        pass.read(visibility, graph::Access::kTransferRead);
        pass.read(frame.depth, graph::Access::kTransferRead);
        pass.execute([picture = frame.color, opaque = frame.depth, visibility, color, keys, depth,
                      size = size_, bytes = visibility_.bytes()](graph::PassContext& context) {
            VkCommandBuffer commands = context.commands().handle();
            const auto copy = [&](graph::ImageHandle image, VkImageAspectFlags aspect,
                                  graph::BufferHandle to) {
                const VkBufferImageCopy region{.imageSubresource = {aspect, 0, 0, 1},
                                               .imageExtent = {size.x, size.y, 1}};
                vkCmdCopyImageToBuffer(commands, context.image(image),
                                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, context.buffer(to), 1,
                                       &region);
            };
            copy(picture, VK_IMAGE_ASPECT_COLOR_BIT, color);
            copy(opaque, VK_IMAGE_ASPECT_DEPTH_BIT, depth);
            const VkBufferCopy whole{.size = bytes};
            vkCmdCopyBuffer(commands, context.buffer(visibility), context.buffer(keys), 1, &whole);
        });
        if (auto done = executor_->execute(frame.graph); !done) return done;
        ++world_.resource<scene::FixedStep>().frame;
        return executor_->wait();
    }

    gpu::Device& device_;
    glm::uvec2 size_;
    World world_;
    Schedule schedule_{"frame"};
    Entity camera_;
    Entity hair_;
    std::unique_ptr<graph::Executor> executor_;
    gpu::Buffer color_;
    gpu::Buffer visibility_;
    gpu::Buffer depth_;
};

/// A groom file's strands upright and in metres, as scenes load it.
inline Result<hair::StrandData> load_upright_strands(const std::filesystem::path& path) {
    auto loaded = hair::load_groom(path);
    if (!loaded) return loaded.error();
    const hair::Upright turn = hair::upright_transform(loaded->groom);
    const auto width = static_cast<float>(hair::default_width(loaded->groom, turn.metres_per_unit));
    return hair::prepare_strands(loaded->groom, turn.to_metres, width);
}

/// How two pictures of the same groom compare; shares are of the first one.
struct CardComparison {
    double luminance[2] = {};   ///< mean over the covered area
    double silhouette[2] = {};  ///< pixels at least half covered by hair alone, without a body
    double outline[2] = {};     ///< pixels at least half covered by hair or the body
    double coverage[2] = {};    ///< pixels of hair in view, by share
    /// Blocks of 8 x 8 pixels that the first covers by at least 0.9 and the second by less than
    /// 0.6.
    int bald_blocks = 0;
    int full_blocks = 0;

    [[nodiscard]] double luminance_error() const { return luminance[1] / luminance[0] - 1.0; }
    [[nodiscard]] double silhouette_error() const { return silhouette[1] / silhouette[0] - 1.0; }
    /// A body makes the outline larger, not the error smaller: a share of the hair's silhouette.
    [[nodiscard]] double outline_error() const { return (outline[1] - outline[0]) / silhouette[0]; }
    [[nodiscard]] double coverage_error() const { return coverage[1] / coverage[0] - 1.0; }
};

inline CardComparison compare(const CardPicture& strands, const CardPicture& cards) {
    CardComparison result;
    const CardPicture* pictures[2] = {&strands, &cards};
    for (int k = 0; k < 2; ++k) {
        double sum = 0.0;
        for (size_t i = 0; i < pictures[k]->color.size(); ++i) {
            sum += glm::dot(glm::dvec3(pictures[k]->color[i]), glm::dvec3(0.2126, 0.7152, 0.0722));
            result.coverage[k] += pictures[k]->coverage[i];
            const float covered = pictures[k]->coverage[i] + pictures[k]->body[i];
            result.outline[k] += covered >= 0.5f ? 1.0 : 0.0;
            result.silhouette[k] += pictures[k]->alone[i] >= 0.5f ? 1.0 : 0.0;
        }
        result.luminance[k] = sum / std::max(result.coverage[k], 1e-9);
    }
    constexpr uint32_t kBlock = 8;
    for (uint32_t y = 0; y + kBlock <= strands.size.y; y += kBlock) {
        for (uint32_t x = 0; x + kBlock <= strands.size.x; x += kBlock) {
            double covered[2] = {};
            for (uint32_t i = 0; i < kBlock * kBlock; ++i) {
                const size_t pixel = size_t{y + i / kBlock} * strands.size.x + x + i % kBlock;
                for (int k = 0; k < 2; ++k) {
                    covered[k] += pictures[k]->coverage[pixel] / (kBlock * kBlock);
                }
            }
            if (covered[0] < 0.9) continue;
            ++result.full_blocks;
            result.bald_blocks += covered[1] < 0.6 ? 1 : 0;
        }
    }
    return result;
}

/// Display pixels, for people to look at.
inline asset::Image to_image(const CardPicture& picture, float exposure) {
    asset::Image image{.width = picture.size.x, .height = picture.size.y, .rgba = {}};
    for (size_t i = 0; i < picture.color.size(); ++i) {
        const glm::vec3 over_grey =
            picture.color[i] * exposure + glm::vec3(0.18f) * (1.0f - picture.coverage[i]);
        for (int c = 0; c < 3; ++c) {
            const float value = std::pow(std::clamp(over_grey[c], 0.0f, 1.0f), 1.0f / 2.2f);
            image.rgba.push_back(static_cast<uint8_t>(std::lround(255.0f * value)));
        }
        image.rgba.push_back(255);
    }
    return image;
}

}  // namespace vellus::test
