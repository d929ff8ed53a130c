#include "assets/generator/walk_scene.h"

#include "assets/generator/figure.h"
#include "assets/generator/ground.h"
#include "assets/generator/trigonometry.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr size_t kStrideKeys = 32;
constexpr size_t kIdleKeys = 48;
constexpr double kIdleSeconds = 8.0;

std::vector<double> key_times(size_t keys, double seconds) {
    std::vector<double> times;
    for (size_t i = 0; i <= keys; ++i) {
        times.push_back(seconds * static_cast<double>(i) / static_cast<double>(keys));
    }
    return times;
}

/// A lap: the path's node turns at an even rate, the figure on it takes its strides.
void add_lap(GltfScene& scene, const Rig& rig, Node path) {
    const Gait gait = lap_gait();
    const size_t keys = kStrideKeys * kLapStrides;
    auto tracks = GltfScene::tracks_of(rig, keys, [&](size_t key) {
        return walk_pose(gait, static_cast<double>(key % kStrideKeys) / kStrideKeys);
    });
    Track turn{path, {}, {}};
    for (size_t key = 0; key <= keys; ++key) {
        turn.rotations.push_back(turn_about(
            {0.0, 1.0, 0.0}, 360.0 * static_cast<double>(key) / static_cast<double>(keys)));
    }
    tracks.push_back(std::move(turn));
    scene.add_clip("stroll", key_times(keys, gait.stride_seconds * kLapStrides), tracks);
}

void add_clips_in_place(GltfScene& scene, const Rig& rig) {
    const Gait gait;
    scene.add_clip(
        "walk", key_times(kStrideKeys, gait.stride_seconds),
        GltfScene::tracks_of(
            rig, kStrideKeys,
            [&](size_t key) { return walk_pose(gait, static_cast<double>(key) / kStrideKeys); }),
        {{"metres_per_second", gait.stride_metres / gait.stride_seconds}});
    scene.add_clip("idle", key_times(kIdleKeys, kIdleSeconds),
                   GltfScene::tracks_of(rig, kIdleKeys, [](size_t key) {
                       return idle_pose(static_cast<double>(key) / kIdleKeys);
                   }));
}

Json hair_extension() {
    return {{"groom", "../grooms/walk.hair"},
            {"upright", false},
            {"transform", groom_transform()},
            {"width", {{"root", 0.00030}, {"tip_scale", 0.4}}},
            {"material",
             {{"melanin", {{"eumelanin", 0.85}, {"pheomelanin", 0.42}}},
              {"color_variation", 0.2},
              {"roughness", 0.30},
              {"shift", 0.035}}}};
}

}  // namespace

Gait lap_gait() {
    Gait gait;
    gait.turn_radius = kLapStrides * gait.stride_metres / 6.283185307179586;
    return gait;
}

GltfScene make_walk_scene(const std::vector<SkinnedPart>& figure) {
    GltfScene scene("walk");
    const double radius = lap_gait().turn_radius;
    const Node path = scene.add_node({{"name", "path"}});
    // On the path's right-hand side seen from its middle, walking along +Z.
    const Node person =
        scene.add_node({{"name", "person"}, {"translation", {-radius, 0.0, 0.0}}}, path);
    const Rig rig = scene.add_rig(figure_joints(), person);
    scene.add_node({{"name", "hair"},
                    {"translation", list(kHeadMiddle - figure_joints()[kHead].position)},
                    {"extensions", {{"VELLUS_hair", hair_extension()}}}},
                   rig.nodes[kHead]);

    Json primitives = Json::array();
    for (const SkinnedPart& part : figure) {
        Json primitive = scene.add_geometry(part);
        primitive["material"] = scene.add_material(part.name, part.base_color, part.roughness);
        primitives.push_back(std::move(primitive));
    }
    const size_t skin = scene.add_skin(rig);
    scene.add_node({{"name", "body"},
                    {"mesh", scene.add_mesh("figure", std::move(primitives))},
                    {"skin", skin}});

    const SkinnedPart ground = make_ground({.path_radius = radius});
    Json lawn = scene.add_geometry(ground);
    lawn["material"] = scene.add_material(ground.name, ground.base_color, ground.roughness);
    scene.add_node({{"name", "ground"}, {"mesh", scene.add_mesh("ground", Json::array({lawn}))}});

    scene.add_camera({1.00, 1.02, 2.75}, {0.05, 0.83, 0.05}, 0.68, person);
    // Where the default sky has its sun.
    scene.add_sun({0.45, 0.62, 0.64}, {1.0, 0.93, 0.82}, 3.2);
    add_lap(scene, rig, path);
    add_clips_in_place(scene, rig);
    return scene;
}

}  // namespace vellus::sculpt
