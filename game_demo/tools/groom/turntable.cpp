#include "game_demo/tools/groom/turntable.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <set>

#include "engine/asset/image_io.h"
#include "engine/platform/user_folders.h"
#include "game_demo/src/content.h"
#include "game_demo/src/progress.h"
#include "game_demo/src/renderer.h"
#include "modules/hair/components.h"
#include "modules/hair/grow/region.h"
#include "modules/hair/spawn.h"
#include "modules/scene/camera.h"
#include "modules/scene/library.h"
#include "modules/scene/view.h"

namespace vellus::groom_tool {

namespace {

constexpr float kFieldOfView = 0.5f;

/// The entity of a node of the scene that was loaded last.
Result<Entity> find_node(const World& world, const std::string& name) {
    const auto& scenes = world.resource<scene::SceneLibrary>();
    std::set<std::string> names;
    const scene::SceneInstance& instance = scenes.instances.back();
    const asset::SceneAsset& asset = scenes.asset_of(instance);
    for (size_t node = 0; node < asset.nodes.size(); ++node) {
        if (instance.nodes[node] == kNoEntity) continue;
        if (asset.nodes[node].name == name) return instance.nodes[node];
        if (!asset.nodes[node].name.empty()) names.insert(asset.nodes[node].name);
    }
    return Error{fmt::format("has no node '{}'", name), asset.path.string(),
                 fmt::format("it has: {}", fmt::join(names, ", "))};
}

/// Takes the hair off a node; its look, where it had some.
void take_off(World& world, Entity node, hair::HairExtension& look) {
    Entity worn = kNoEntity;
    world
        .query<Entity, const hair::Hair, const scene::Parent, const hair::HairMaterial,
               const hair::HairWidth>()
        .each([&](Entity entity, const hair::Hair&, const scene::Parent& parent,
                  const hair::HairMaterial& material, const hair::HairWidth& width) {
            if (parent.entity != node) return;
            worn = entity;
            look.material = material;
            look.width = width;
        });
    if (worn != kNoEntity) world.destroy(worn);
}

/// Translation, rotation and one scale that undo a node's place.
void undo(const glm::dmat4& place, hair::HairExtension& look) {
    const glm::dmat4 back = glm::inverse(place);
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(back))));
    look.translation = glm::dvec3(back[3]);
    look.rotation = glm::normalize(glm::quat_cast(glm::dmat3(back) / scale));
    look.scale = glm::dvec3(scale);
}

Result<void> check_folder(const std::filesystem::path& folder) {
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (std::filesystem::is_directory(folder, code)) return {};
    return Error{"cannot make this folder", folder.string(), "give another one with --out"};
}

class Photographer {
  public:
    Photographer(const Turntable& turntable, gpu::Device& device, demo::Renderer& renderer)
        : turntable_(turntable), device_(device), renderer_(renderer), world_(renderer.world()) {}

    Result<void> load() {
        demo::Options options = turntable_.renderer;
        options.scene = turntable_.scene.empty() ? turntable_.groom : turntable_.scene;
        options.dt = 0.0;
        if (auto loaded = demo::load_content(renderer_, options); !loaded) {
            return loaded.error();
        }
        if (!turntable_.scene.empty()) {
            if (auto worn = put_on(); !worn) return worn;
        }
        dress();
        if (auto settled = renderer_.settle(); !settled) return settled;
        find_center();
        take_camera();
        return {};
    }

    Result<asset::Image> picture(uint32_t view) {
        const double yaw = 2.0 * std::numbers::pi * view / turntable_.views;
        const scene::CameraPose pose =
            scene::orbit_pose(center_, distance_, yaw, turntable_.pitch, kFieldOfView);
        *world_.get<scene::LocalTransform>(camera_) = scene::local_transform(pose);
        world_.get<scene::Camera>(camera_)->near_plane = static_cast<float>(0.02 * distance_);
        if (auto settled = renderer_.settle(); !settled) return settled.error();
        for (uint32_t frame = 1; frame <= turntable_.frames; ++frame) {
            const bool last = frame == turntable_.frames;
            auto drawn = renderer_.draw(last ? demo::Output::kPixels : demo::Output::kNowhere);
            if (!drawn) return drawn.error();
            if (auto done = renderer_.wait(); !done) return done.error();
        }
        return renderer_.pixels();
    }

  private:
    Result<void> put_on() {
        hair::HairExtension look;
        look.upright = !turntable_.as_is;
        Entity node = kNoEntity;
        if (!turntable_.node.empty()) {
            auto found = find_node(world_, turntable_.node);
            if (!found) return found.error();
            node = *found;
            take_off(world_, node, look);
            if (auto settled = renderer_.settle(); !settled) return settled;
            if (!turntable_.in_node_space) {
                undo(world_.get<scene::WorldTransform>(node)->matrix, look);
            }
        }
        auto hair = hair::spawn_hair(world_, device_, turntable_.groom, look, node);
        if (!hair) return hair.error();
        hair_ = *hair;
        return {};
    }

    /// The look asked for on the command line.
    void dress() {
        if (hair_ == kNoEntity) {
            world_.query<Entity, const hair::Hair>().each(
                [&](Entity entity, const hair::Hair&) { hair_ = entity; });
        }
        auto* width = world_.get<hair::HairWidth>(hair_);
        const auto& groom =
            world_.resource<hair::HairLibrary>().grooms[world_.get<hair::Hair>(hair_)->groom];
        // A groom's own diameters are the truth about its tips.
        if (groom.has_width_column) *width = {.root = 0.0f, .tip_scale = 1.0f};
        if (turntable_.tip_scale >= 0.0f) width->tip_scale = turntable_.tip_scale;
        if (!turntable_.color) return;
        auto* material = world_.get<hair::HairMaterial>(hair_);
        material->base_color = material->tip_color = *turntable_.color;
        material->use_groom_colors = false;
    }

    void find_center() {
        const glm::dmat4 place = world_.get<scene::WorldTransform>(hair_)->matrix;
        const auto& groom =
            world_.resource<hair::HairLibrary>().grooms[world_.get<hair::Hair>(hair_)->groom];
        scene::Box box;
        for (const glm::vec3& p : groom.outermost) box.include(place * glm::dvec4(p, 1.0));
        center_ = box.empty() ? glm::dvec3(0.0) : box.center();
        double radius = 1e-6;
        for (const glm::vec3& p : groom.outermost) {
            radius =
                std::max(radius, glm::distance(glm::dvec3(place * glm::dvec4(p, 1.0)), center_));
        }
        const glm::dvec2 size(world_.resource<scene::ViewSettings>().size);
        const double narrow = std::min(1.0, size.x / size.y);
        distance_ = 1.05 * radius / (std::sin(kFieldOfView / 2.0) * narrow * turntable_.zoom);
    }

    void take_camera() {
        std::vector<Entity> active;
        world_.query<Entity, const scene::ActiveCamera>().each(
            [&](Entity entity, const scene::ActiveCamera&) { active.push_back(entity); });
        for (const Entity entity : active) world_.remove<scene::ActiveCamera>(entity);
        camera_ = world_.spawn(scene::Camera{kFieldOfView, 0.02f}, scene::LocalTransform{},
                               scene::WorldTransform{}, scene::PreviousWorldTransform{},
                               scene::ActiveCamera{});
    }

    const Turntable& turntable_;
    gpu::Device& device_;
    demo::Renderer& renderer_;
    World& world_;
    Entity hair_ = kNoEntity;
    Entity camera_ = kNoEntity;
    glm::dvec3 center_{0.0};
    double distance_ = 1.0;
};

}  // namespace

asset::Image make_sheet(const std::vector<asset::Image>& pictures, uint32_t columns) {
    if (pictures.empty()) return {};
    const uint32_t width = pictures.front().width;
    const uint32_t height = pictures.front().height;
    const auto rows = static_cast<uint32_t>((pictures.size() + columns - 1) / columns);
    asset::Image sheet{columns * width, rows * height, {}};
    sheet.rgba.assign(size_t{4} * sheet.width * sheet.height, 255);
    for (size_t i = 0; i < pictures.size(); ++i) {
        const size_t left = i % columns * width;
        const size_t top = i / columns * height;
        for (size_t y = 0; y < height; ++y) {
            std::copy_n(&pictures[i].rgba[4 * y * width], size_t{4} * width,
                        &sheet.rgba[4 * ((top + y) * sheet.width + left)]);
        }
    }
    return sheet;
}

Result<void> write_turntable(const Turntable& turntable) {
    if (auto ok = check_folder(turntable.out); !ok) return ok;
    auto device = gpu::Device::create({.name = turntable.renderer.device,
                                       .validation = turntable.renderer.validation,
                                       .pipeline_cache_folder = cache_folder()});
    if (!device) return device.error();
    auto renderer = demo::Renderer::create(**device, {});
    if (!renderer) return renderer.error();
    Photographer photographer(turntable, **device, **renderer);
    if (auto loaded = photographer.load(); !loaded) return loaded;
    std::vector<asset::Image> pictures;
    demo::Progress progress(turntable.views, "views");
    for (uint32_t view = 0; view < turntable.views; ++view) {
        auto picture = photographer.picture(view);
        if (!picture) return picture.error();
        const auto file = turntable.out / fmt::format("view_{:02}.png", view);
        if (auto saved = asset::save_png(file, *picture); !saved) return saved;
        if (turntable.sheet) pictures.push_back(std::move(*picture));
        progress.update(view + 1);
    }
    if (turntable.sheet) {
        const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(pictures.size())));
        auto saved = asset::save_png(turntable.out / "sheet.png", make_sheet(pictures, columns));
        if (!saved) return saved;
    }
    if ((*device)->validation_messages() == 0) return {};
    return Error{fmt::format("{} validation messages", (*device)->validation_messages()),
                 turntable.groom.string(), "see above"};
}

}  // namespace vellus::groom_tool
