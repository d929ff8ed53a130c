#include "assets/generator/asset_files.h"

#include <span>

#include "assets/generator/bust_mesh.h"
#include "assets/generator/crowd_scene.h"
#include "assets/generator/figure_mesh.h"
#include "assets/generator/fox.h"
#include "assets/generator/fur_scene.h"
#include "assets/generator/groom_of.h"
#include "assets/generator/hair_style.h"
#include "assets/generator/portrait.h"
#include "assets/generator/walk_scene.h"
#include "modules/hair/groom/groom_file.h"

namespace vellus::sculpt {

Result<std::vector<AssetFile>> make_asset_files() {
    std::vector<AssetFile> files;
    const auto add_groom = [&](const std::string& path, const hair::Groom& groom) -> Result<void> {
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
         to_groom(grow_hair({.directions = 7'500, .points = 14, .length = 0.80}), 0.03F,
                  "Hair over the shoulders")},
    };
    for (const Grown& grown : grooms) {
        if (auto added = add_groom(grown.path, grown.groom); !added) {
            return added.error();
        }
    }
    Portrait portrait = make_portrait(make_bust());
    add_text("scenes/portrait.gltf", portrait.json);
    files.push_back({"scenes/portrait.bin", std::move(portrait.buffer)});
    const auto add_scene = [&](const GltfScene& scene) {
        add_text("scenes/" + scene.name() + ".gltf", scene.json());
        files.push_back({"scenes/" + scene.name() + ".bin", scene.buffer()});
    };
    add_scene(make_walk_scene(make_figure(false)));
    const std::vector<SkinnedPart> people = make_figure(true);
    add_scene(make_crowd_scene(people));
    auto crowd_hair = grow_crowd_hair(people[0], people[1]);
    if (!crowd_hair) {
        return crowd_hair.error();
    }
    const std::vector<SkinnedPart> fox = make_fox();
    add_scene(make_fur_scene(fox));
    Fur fur = grow_fox_fur(fox[0]);
    hair::Groom fox_groom = to_groom(fur.strands, 0.16F, "Fur of a fox");
    fox_groom.colors = std::move(fur.colors);
    if (auto added = add_groom("grooms/fox.hair", fox_groom); !added) {
        return added.error();
    }
    for (const CrowdGroom& grown : *crowd_hair) {
        if (auto added = add_groom("grooms/" + grown.file, grown.groom); !added) {
            return added.error();
        }
    }
    return files;
}

}  // namespace vellus::sculpt
