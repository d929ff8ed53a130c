#include "assets/generator/asset_files.h"

#include <glm/glm.hpp>
#include <span>

#include "assets/generator/bust_mesh.h"
#include "assets/generator/figure_mesh.h"
#include "assets/generator/hair_style.h"
#include "assets/generator/portrait.h"
#include "assets/generator/walk_scene.h"
#include "modules/hair/groom/groom_file.h"

namespace vellus::sculpt {

namespace {

/// Strands as the .hair format has them: centimetres, Z up, so the face looks along -Y.
hair::Groom to_groom(const std::vector<Strand>& strands, float thickness, const char* info) {
    hair::Groom groom;
    groom.format = hair::GroomFormat::kHair;
    groom.default_thickness = thickness;
    groom.info = info;
    for (const Strand& strand : strands) {
        for (const glm::dvec3 p : strand) {
            groom.points.emplace_back(glm::dvec3(p.x, -p.z, p.y) * 100.0);
        }
        groom.strand_begin.push_back(static_cast<uint32_t>(groom.points.size()));
    }
    return groom;
}

}  // namespace

Result<std::vector<AssetFile>> make_asset_files() {
    std::vector<AssetFile> files;
    const auto add_groom = [&](const char* path, const hair::Groom& groom) -> Result<void> {
        Result<std::vector<std::byte>> bytes = hair::write_hair(groom);
        if (!bytes) {
            return bytes.error();
        }
        files.push_back({path, *std::move(bytes)});
        return {};
    };
    const auto add_text = [&](const std::string& path, const std::string& text) {
        const auto bytes = std::as_bytes(std::span(text));
        files.push_back({path, {bytes.begin(), bytes.end()}});
    };
    struct Grown {
        const char* path;
        hair::Groom groom;
    };
    const Grown grooms[] = {
        {"grooms/long.hair", to_groom(grow_hair(), 0.009F, "Long hair")},
        {"grooms/brows.hair", to_groom(grow_brows(), 0.011F, "Brows, lashes")},
        {"grooms/walk.hair",
         to_groom(grow_hair({.directions = 6'000, .points = 13, .length = 0.72}), 0.03F,
                  "Shoulder-length hair")},
    };
    for (const Grown& grown : grooms) {
        if (auto added = add_groom(grown.path, grown.groom); !added) {
            return added.error();
        }
    }
    Portrait portrait = make_portrait(make_bust());
    add_text("scenes/portrait.gltf", portrait.json);
    files.push_back({"scenes/portrait.bin", std::move(portrait.buffer)});
    const GltfScene walk = make_walk_scene(make_figure(false));
    add_text("scenes/walk.gltf", walk.json());
    files.push_back({"scenes/walk.bin", walk.buffer()});
    return files;
}

}  // namespace vellus::sculpt
