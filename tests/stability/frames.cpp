#include "tests/stability/frames.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "engine/frame_graph/context.h"
#include "modules/hair/geometry/hair_passes.h"
#include "modules/light/load_environment.h"
#include "modules/scene/stages.h"
#include "modules/temporal/temporal.h"
#include "shaders/common/portable.h"
#include "tests/support/sampling.h"

namespace vellus::test {

namespace glsl {
using namespace vellus::glsl;  // NOLINT(google-build-using-namespace)
#include "common/tonemap.glsl"
}  // namespace glsl

namespace {

using graph::Access;

bool is_fine(const glm::vec4& value) {
    for (int c = 0; c < 3; ++c) {
        if (!std::isfinite(value[c]) || value[c] < 0.0f) return false;
    }
    return true;
}

void describe_injection(Res<Injection> injection, Res<scene::RenderFrame> frame) {
    if (!std::exchange(injection->armed, false)) return;
    const auto texel =
        frame->graph.import_buffer("test/texel", {injection->texel.bytes()}, &injection->texel,
                                   Access::kTransferRead, Access::kTransferRead);
    auto pass = frame->graph.add_pass("test/inject", graph::PassKind::kTransfer);
    pass.read(texel, Access::kTransferRead);
    frame->color = pass.write(frame->color, Access::kTransferWrite);
    pass.execute([texel, color = frame->color, at = injection->at](graph::PassContext& context) {
        const VkBufferImageCopy region{
            .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
            .imageOffset = {static_cast<int32_t>(at.x), static_cast<int32_t>(at.y), 0},
            .imageExtent = {1, 1, 1}};
        vkCmdCopyBufferToImage(context.commands().handle(), context.buffer(texel),
                               context.image(color), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                               &region);
    });
}

}  // namespace

double display_error(const Pixels& a, const Pixels& b, std::string* where) {
    double worst = a.size() == b.size() ? 0.0 : std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const glm::vec3 shown = glsl::display_color(a[i], 1.0f);
        const glm::vec3 other = glsl::display_color(b[i], 1.0f);
        double error = 0.0;
        for (int c = 0; c < 3; ++c) error = std::max(error, std::abs(double{shown[c]} - other[c]));
        if (!is_fine(a[i]) || !is_fine(b[i])) error = std::numeric_limits<double>::infinity();
        if (error <= worst) continue;
        worst = error;
        if (where) *where = fmt::format("pixel {}: {:.4g} and {:.4g}", i, a[i].g, b[i].g);
    }
    return worst;
}

double bad_values(const Pixels& picture) {
    double bad = 0.0;
    for (const glm::vec4& value : picture) bad += is_fine(value) ? 0.0 : 1.0;
    return bad;
}

std::vector<std::vector<glm::vec3>> wavy_tuft(size_t count, size_t points, uint64_t seed) {
    std::vector<std::vector<glm::vec3>> strands(count);
    for (size_t s = 0; s < count; ++s) {
        Random random(seed, s);
        const glm::dvec3 root(random.range(-0.2, 0.2), random.range(0.1, 0.2),
                              -random.range(0.5, 0.9));
        const double phase = random.range(0.0, 6.28);
        for (size_t i = 0; i < points; ++i) {
            const double t = static_cast<double>(i) / static_cast<double>(points - 1);
            const double wave = 0.02 * t * std::sin(12.0 * t + phase);
            strands[s].emplace_back(root + glm::dvec3(wave, -0.3 * t, 0.5 * wave));
        }
    }
    return strands;
}

hair::StrandData rooted_strands(const std::vector<std::vector<glm::vec3>>& strands, float width) {
    hair::StrandData data = make_strands(strands, width);
    for (size_t s = 0; s < data.strand_count(); ++s) {
        const glm::vec3 root = data.positions[data.strand_begin[s]];
        data.strand_seed[s] = glsl::hash_uint(std::bit_cast<uint32_t>(root.x) ^
                                              glsl::hash_uint(std::bit_cast<uint32_t>(root.y)));
    }
    return data;
}

hair::HairExtension plain_look() {
    hair::HairExtension look;
    look.material.base_color = look.material.tip_color = {0.7f, 0.5f, 0.3f};
    look.material.color_variation = 0.0f;
    look.width.tip_scale = 1.0f;
    return look;
}

void Injection::arm(const glm::uvec2& pixel, uint16_t half) {
    constexpr uint16_t kOne = 0x3c00;
    const uint16_t halves[] = {half, half, half, kOne};
    texel.write(std::span<const uint16_t>(halves));
    at = pixel;
    armed = true;
}

void add_injection(World& world, Schedule& schedule, gpu::Device& device) {
    auto texel = gpu::Buffer::create(device, 8, gpu::MemoryKind::kUpload, "test texel");
    EXPECT_TRUE(texel);
    world.insert_resource(Injection{.texel = std::move(*texel)});
    schedule.add(describe_injection).in(scene::kHair).after(hair::describe_hair);
}

TuftScene::TuftScene(gpu::Device& device, uint32_t width, uint32_t height,
                     const std::function<void(TuftScene&)>& set_up)
    : HairScene(device, width, height) {
    EXPECT_TRUE(light::use_sky(world, device, {}));
    world.resource<temporal::TemporalSettings>().enabled = true;
    sun = add_sun(glm::normalize(glm::vec3(0.3f, 0.6f, 0.8f)));
    tuft = add_hair(rooted_strands(wavy_tuft(300), 0.002f), plain_look());
    if (set_up) set_up(*this);
    build();
}

Pixels TuftScene::draw_frames(int count) {
    Pixels picture;
    for (int frame = 0; frame < count; ++frame) picture = draw();
    return picture;
}

Pixels TuftScene::draw_cut() {
    auto& view = world.resource<scene::ViewSettings>();
    view.cut = true;
    Pixels picture = draw();
    view.cut = false;
    return picture;
}

void TuftScene::place(const glm::dvec3& offset) {
    for (const Entity entity : {tuft, camera}) {
        world.get<scene::LocalTransform>(entity)->translation = offset;
    }
}

}  // namespace vellus::test
