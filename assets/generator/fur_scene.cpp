#include "assets/generator/fur_scene.h"

#include "assets/generator/fox.h"

namespace vellus::sculpt {

GltfScene make_fur_scene(const std::vector<SkinnedPart>& fox) {
    constexpr size_t kKeys = 96;
    constexpr double kSeconds = 8.0;
    GltfScene scene("fur");
    const Node animal = scene.add_node({{"name", "fox"}});
    const Rig rig = scene.add_rig(fox_joints(), animal);
    Json primitives = Json::array();
    for (const SkinnedPart& part : fox) {
        primitives.push_back(scene.add_geometry(part));
        primitives.back()["material"] =
            scene.add_material(part.name, part.base_color, part.roughness);
    }
    const size_t skin = scene.add_skin(rig);
    const Node body = scene.add_node(
        {{"name", "body"}, {"mesh", scene.add_mesh("fox", std::move(primitives))}, {"skin", skin}});
    scene.add_hair("fur", "fox.hair", {0.0, 0.0, 0.0},
                   {{"width", {{"root", 0.0019}, {"tip_scale", 0.3}}},
                    {"binding", {{"mesh", body}}},
                    {"material",
                     {{"use_groom_colors", true},
                      {"color_variation", 0.12},
                      {"roughness", 0.45},
                      {"specular", 0.6}}}},
                   animal);
    scene.add_ground({.path_radius = 6.0, .path_width = 1.4, .center = {-3.4, 0.0, -4.0}});
    scene.add_camera({0.72, 0.62, 1.02}, {0.0, 0.345, 0.0}, 0.66);
    scene.add_sun({0.45, 0.62, 0.64}, {1.0, 0.93, 0.82}, 3.2);
    scene.add_clip("look_around", GltfScene::key_times(kKeys, kSeconds),
                   GltfScene::tracks_of(rig, kKeys, [](size_t key) {
                       return fox_pose(static_cast<double>(key % kKeys) / kKeys);
                   }));
    return scene;
}

}  // namespace vellus::sculpt
