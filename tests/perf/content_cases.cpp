#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "engine/asset/gltf.h"
#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "modules/hair/binding/bind_roots.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/groom_report.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/groom/upright.h"
#include "modules/hair/grow/grow.h"
#include "tests/perf/engine_cases.h"

namespace vellus::bench {

namespace {

namespace fs = std::filesystem;

constexpr uint32_t kSide = 512;
constexpr uint32_t kSeed = 7;
constexpr uint32_t kStrands = 4'000;
constexpr uint32_t kGrown = 500;  // in a round of growing

fs::path asset_file(const char* name) {
    return fs::path(VELLUS_ASSET_DIR) / name;
}

/// Loading is one thread's work or all cores', so its time is the wall's.
template <class Load, class Verify>
EngineCase load_case(Load load, Verify verify) {
    return {[=] {
                bool good = false;
                decltype(load()) loaded = Error{};
                const double seconds = wall_seconds_of([&] { loaded = load(); });
                if (loaded) good = verify(*loaded);
                return Timed{seconds, good};
            },
            {}};
}

EngineCase scene_case(const char* name, size_t meshes) {
    return load_case([path = asset_file(name)] { return asset::load_gltf(path); },
                     [=](const asset::SceneAsset& scene) { return scene.meshes.size() == meshes; });
}

EngineCase groom_file_case(const char* name, size_t strands) {
    return load_case(
        [path = asset_file(name)] { return hair::load_groom(path); },
        [=](const hair::LoadedGroom& loaded) { return loaded.groom.strand_count() == strands; });
}

/// A picture that no coding makes nothing of: smooth, with a grain.
asset::ImageF test_picture() {
    asset::ImageF picture{.width = kSide, .height = kSide};
    picture.rgba.resize(size_t{4} * kSide * kSide, 1.0f);
    uint32_t grain = 1;
    for (size_t i = 0; i < picture.rgba.size(); ++i) {
        grain = grain * 1664525U + 1013904223U;
        if (i % 4 == 3) continue;
        const float smooth = 1.0f + std::sin(1e-4f * static_cast<float>(i));
        picture.rgba[i] = smooth + 0.05f * static_cast<float>(grain >> 8U) / 16777216.0f;
    }
    return picture;
}

asset::Image in_bytes(const asset::ImageF& picture) {
    asset::Image image{picture.width, picture.height, {}};
    image.rgba.reserve(picture.rgba.size());
    for (const float value : picture.rgba) {
        image.rgba.push_back(static_cast<uint8_t>(120.0f * value));
    }
    return image;
}

using Bytes = std::vector<std::byte>;

Result<EngineCase> picture_case(const Result<Bytes>& encoded) {
    if (!encoded) return encoded.error();
    return load_case(
        [file = std::make_shared<Bytes>(*encoded)] { return asset::decode_image_f(*file); },
        [](const asset::ImageF& picture) { return picture.width == kSide; });
}

Result<hair::Groom> grow(hair::GrowStyle style, uint32_t strands) {
    hair::GrowSettings settings = hair::preset(style);
    settings.count = strands;
    auto groom =
        hair::grow_groom(hair::sphere_surface({0.0f, 1.6f, 0.0f}, 0.1f, false), settings, kSeed);
    if (groom) hair::repair(*groom);
    return groom;
}

double bytes_of(const hair::StrandData& data) {
    const auto bytes = [](const auto& column) {
        return static_cast<double>(column.size() * sizeof(column[0]));
    };
    return bytes(data.positions) + bytes(data.point_parameter) + bytes(data.point_width) +
           bytes(data.point_color) + bytes(data.strand_begin) + bytes(data.strand_source) +
           bytes(data.strand_seed) + bytes(data.strand_uv) + bytes(data.strand_length) +
           bytes(data.segment_point) + bytes(data.segment_strand);
}

struct Prepared {
    hair::Groom groom;
    hair::StrandData data;
};

Result<EngineCase> prepare_case() {
    auto groom = grow(hair::GrowStyle::kWavy, kStrands);
    if (!groom) return groom.error();
    auto state = std::make_shared<Prepared>(Prepared{std::move(*groom), {}});
    return EngineCase{[=] {
                          const double seconds = wall_seconds_of([&] {
                              state->data =
                                  hair::prepare_strands(state->groom, glm::dmat4(1.0), 1e-4f);
                          });
                          return Timed{seconds, state->data.strand_count() == kStrands};
                      },
                      [=] { return bytes_of(state->data); }};
}

/// The haired ball's own triangles as the mesh that the roots are bound to.
hair::RestMesh ball_mesh() {
    const hair::GrowSurface ball = hair::sphere_surface({0.0f, 1.6f, 0.0f}, 0.1f, false);
    hair::RestMesh mesh;
    mesh.positions.assign(ball.positions.begin(), ball.positions.end());
    mesh.normals.assign(ball.normals.begin(), ball.normals.end());
    mesh.vertices.resize(ball.positions.size());
    for (size_t i = 0; i < ball.triangles.size(); i += 3) {
        mesh.triangles.emplace_back(ball.triangles[i], ball.triangles[i + 1],
                                    ball.triangles[i + 2]);
    }
    return mesh;
}

Result<EngineCase> bind_case() {
    auto groom = grow(hair::GrowStyle::kShort, kStrands);
    if (!groom) return groom.error();
    auto strands =
        std::make_shared<hair::StrandData>(hair::prepare_strands(*groom, glm::dmat4(1.0), 1e-4f));
    auto mesh = std::make_shared<hair::RestMesh>(ball_mesh());
    return load_case(
        [=] {
            return hair::bind_roots({strands->positions, strands->strand_begin}, glm::dmat4(1.0),
                                    *mesh);
        },
        [](const hair::BoundRoots& bound) { return bound.roots.size() == kStrands; });
}

}  // namespace

std::vector<EngineCaseMaker> asset_cases() {
    return {
        {"assets/walk.gltf",
         []() -> Result<EngineCase> { return scene_case("scenes/walk.gltf", 2); }},
        {"assets/crowd.gltf",
         []() -> Result<EngineCase> { return scene_case("scenes/crowd.gltf", 10); }},
        {"assets/long.hair",
         []() -> Result<EngineCase> { return groom_file_case("grooms/long.hair", 14707); }},
        {"assets/png", [] { return picture_case(asset::encode_png(in_bytes(test_picture()))); }},
        {"assets/exr", [] { return picture_case(asset::encode_exr(test_picture())); }},
        {"assets/hdr", [] { return picture_case(asset::encode_hdr(test_picture())); }}};
}

std::vector<EngineCaseMaker> groom_cases() {
    std::vector<EngineCaseMaker> makers{{"groom/prepare strands", prepare_case},
                                        {"groom/bind roots", bind_case}};
    for (const auto style : {hair::GrowStyle::kStraight, hair::GrowStyle::kCurly,
                             hair::GrowStyle::kBraid, hair::GrowStyle::kFur}) {
        makers.push_back({fmt::format("groom/grow {}", hair::grow_style_name(style)),
                          [=]() -> Result<EngineCase> {
                              return load_case([=] { return grow(style, kGrown); },
                                               [](const hair::Groom& groom) {
                                                   return groom.strand_count() == kGrown;
                                               });
                          }});
    }
    return makers;
}

}  // namespace vellus::bench
