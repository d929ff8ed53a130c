#include "tests/perf/hair_rig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "engine/frame_graph/context.h"
#include "modules/character/register.h"
#include "modules/display/readback.h"
#include "modules/display/register.h"
#include "modules/hair/binding/bind_hair.h"
#include "modules/hair/geometry/hair_frame.h"
#include "modules/hair/register.h"
#include "modules/hair/spawn.h"
#include "modules/light/environment.h"
#include "modules/light/light_set.h"
#include "modules/light/load_environment.h"
#include "modules/light/register.h"
#include "modules/scene/camera.h"
#include "modules/scene/instantiate.h"
#include "modules/scene/register.h"
#include "modules/scene/render_frame.h"
#include "modules/temporal/register.h"
#include "modules/temporal/temporal.h"

namespace vellus::bench {

namespace {

/// Three-quarter view, a little from above: what the demo shows of a bare groom.
constexpr double kYaw = 0.5;
constexpr double kPitch = 0.1;
constexpr double kFill = 0.95;

Result<void> light_evenly(World& world, gpu::Device& device) {
    asset::ImageF white{.width = 4, .height = 2, .rgba = std::vector<float>(4 * 2 * 4, 1.0f)};
    auto environment = light::make_environment(device, white, 1.0f, 0.0f);
    if (!environment) return environment.error();
    environment->drawn = false;
    world.resource<light::Environment>() = std::move(*environment);
    return {};
}

/// A sphere through the box's sides, its upper half carried by the second joint.
asset::Mesh sphere_on_two_joints(const scene::Box& box) {
    constexpr uint32_t kAround = 64;
    constexpr uint32_t kRows = 32;
    asset::Primitive sphere;
    for (uint32_t row = 0; row <= kRows; ++row) {
        for (uint32_t i = 0; i < kAround; ++i) {
            const double polar = std::numbers::pi * row / kRows;
            const double azimuth = 2.0 * std::numbers::pi * i / kAround;
            const glm::dvec3 n(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                               std::sin(polar) * std::sin(azimuth));
            sphere.positions.emplace_back(box.center() + 0.5 * n * (box.max - box.min));
            sphere.normals.emplace_back(n);
            sphere.joints.emplace_back(0, 1, 0, 0);
            const auto upper = static_cast<float>(std::clamp(n.y + 0.5, 0.0, 1.0));
            sphere.weights.emplace_back(1.0f - upper, upper, 0.0f, 0.0f);
            if (row == kRows) continue;
            const uint32_t a = row * kAround + i;
            const uint32_t b = row * kAround + (i + 1) % kAround;
            for (const uint32_t v : {a, b, b + kAround, a, b + kAround, a + kAround}) {
                sphere.indices.push_back(v);
            }
        }
    }
    return {"sphere", {sphere}, {}};
}

scene::CameraPose framed(const hair::LibraryGroom& groom, glm::uvec2 size) {
    const std::vector<glm::dvec3> points(groom.outermost.begin(), groom.outermost.end());
    return scene::frame_points(points, kYaw, kPitch, static_cast<double>(size.x) / size.y, kFill);
}

}  // namespace

Result<std::unique_ptr<HairRig>> HairRig::create(const HairRigOptions& options) {
    std::unique_ptr<HairRig> rig(new HairRig);
    if (auto done = rig->set_up(options); !done) return done.error();
    return rig;
}

HairRig::~HairRig() {
    if (executor_) static_cast<void>(executor_->wait());
}

Result<void> HairRig::set_up(const HairRigOptions& options) {
    auto device = gpu::Device::create({.name = options.device});
    if (!device) return device.error();
    device_ = std::move(*device);
    if (auto done = scene::insert_render_frame(world_, *device_); !done) return done;
    scene::register_scene(world_, schedule_);
    character::register_character(world_, schedule_);
    light::register_light(world_, schedule_);
    hair::register_hair(world_, schedule_);
    temporal::register_temporal(world_, schedule_);
    display::register_display(world_, schedule_);

    hair::HairExtension look;
    if (options.white) {
        look.material.base_color = look.material.tip_color = glm::vec3(0.9f);
        look.material.color_variation = 0.0f;
        look.material.use_groom_colors = false;
        if (auto lit = light_evenly(world_, *device_); !lit) return lit;
    } else {
        if (auto sky = light::use_sky(world_, *device_, {}); !sky) return sky;
        light::spawn_sun(world_, {});
    }
    auto groom = options.strands
                     ? hair::add_strands(world_, *device_, "strands", *options.strands, {})
                     : hair::add_groom(world_, *device_, options.groom, true);
    if (!groom) return groom.error();
    const Entity hair = hair::spawn_hair(world_, *groom, look, options.techniques, kNoEntity);
    if (options.bound) {
        if (auto bound = bind(hair, *groom); !bound) return bound;
    }
    const glm::uvec2 size{options.width, options.height};
    scene::spawn_camera(world_, framed(world_.resource<hair::HairLibrary>().grooms[*groom], size));
    world_.resource<scene::ViewSettings>().size = size;
    // The benchmark compares fixed maps, whatever the framing.
    world_.resource<light::ShadowSettings>().fit_to_picture = false;
    world_.resource<temporal::TemporalSettings>().enabled = options.temporal;
    if (auto built = schedule_.build(world_); !built) return built;

    auto executor = graph::Executor::create(*device_, scene::kFramesInFlight);
    if (!executor) return executor.error();
    executor_ = std::move(*executor);
    pixels_ = size_t{size.x} * size.y;
    auto buffer =
        gpu::Buffer::create(*device_, pixels_ * 8, gpu::MemoryKind::kReadback, "readback");
    if (!buffer) return buffer.error();
    readback_ = std::move(*buffer);
    return {};
}

Result<void> HairRig::bind(Entity hair, uint32_t groom) {
    const auto& shape = world_.resource<hair::HairLibrary>().grooms[groom];
    scene::Box roots;
    for (size_t s = 0; s + 1 < shape.strand_begin.size(); ++s) {
        roots.include(glm::dvec3(shape.positions[shape.strand_begin[s]]));
    }
    auto asset = std::make_shared<asset::SceneAsset>();
    asset->meshes = {sphere_on_two_joints(roots)};
    asset->nodes = {{.name = "scalp", .mesh = 0, .skin = 0}, {.name = "neck"}, {.name = "head"}};
    asset->roots = {0, 1, 2};
    asset->skins = {{"skin", {1, 2}, {}}};
    auto instance = scene::instantiate(world_, asset);
    if (!instance) return instance.error();
    const auto& library = world_.resource<scene::SceneLibrary>();
    nodding_ = library.entity(*instance, 2);
    return hair::bind_hair(world_, *device_, hair, library.entity(*instance, 0));
}

void HairRig::nod() {
    if (nodding_ == kNoEntity) return;
    const auto frame = static_cast<float>(world_.resource<scene::FixedStep>().frame);
    world_.get<scene::LocalTransform>(nodding_)->rotation =
        glm::angleAxis(0.02f * std::sin(0.3f * frame), glm::vec3(1, 0, 0));
}

void HairRig::read_back(Wanted wanted) {
    auto& frame = world_.resource<scene::RenderFrame>();
    if (wanted == Wanted::kLinear) {
        return display::describe_readback(frame, frame.color, readback_);
    }
    const auto visibility = world_.resource<hair::HairFrame>().visibility;
    auto target = frame.graph.import_buffer("readback", {readback_.bytes()}, &readback_,
                                            graph::Access::kNone, graph::Access::kHostRead);
    auto pass = frame.graph.add_pass("bench/readback", graph::PassKind::kTransfer);
    pass.read(visibility, graph::Access::kTransferRead);
    target = pass.write(target, graph::Access::kTransferWrite, graph::Load::kDiscard);
    pass.execute([visibility, target, bytes = readback_.bytes()](graph::PassContext& context) {
        const VkBufferCopy region{.size = bytes};
        vkCmdCopyBuffer(context.commands().handle(), context.buffer(visibility),
                        context.buffer(target), 1, &region);
    });
    frame.graph.output(target);
}

Result<void> HairRig::draw(Wanted wanted) {
    if (auto begun = executor_->begin_frame(); !begun) return begun;
    nod();
    schedule_.run(world_);
    auto& frame = world_.resource<scene::RenderFrame>();
    if (frame.error) return *frame.error;
    if (wanted == Wanted::kPicture) {
        frame.graph.output(frame.display);
    } else {
        read_back(wanted);
    }
    last_ = wanted;
    if (auto done = executor_->execute(frame.graph); !done) return done;
    ++world_.resource<scene::FixedStep>().frame;
    return executor_->wait();
}

std::vector<float> HairRig::values() const {
    std::vector<float> values(pixels_);
    const auto* words = reinterpret_cast<const uint64_t*>(readback_.mapped());
    for (size_t i = 0; i < pixels_; ++i) {
        values[i] = last_ == Wanted::kLinear ? glm::unpackHalf4x16(words[i]).g
                                             : (words[i] != 0 ? 1.0f : 0.0f);
    }
    return values;
}

uint64_t HairRig::objects_created() const {
    return executor_->objects_created() + device_->pipelines().created();
}

}  // namespace vellus::bench
