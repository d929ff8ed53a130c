#include "assets/generator/walk_scene.h"

#include "assets/generator/figure.h"
#include "assets/generator/figure_colliders.h"
#include "assets/generator/trigonometry.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr size_t kStrideKeys = 32;
constexpr size_t kIdleKeys = 48;
constexpr double kIdleSeconds = 8.0;

/// A lap: the figure goes round at an even speed and takes its strides.
void add_lap(GltfScene& scene, const Rig& rig, Node person) {
    const Gait gait = lap_gait();
    const double speed = gait.stride_metres / gait.stride_seconds;
    const size_t keys = kStrideKeys * kLapStrides;
    auto tracks = GltfScene::tracks_of(rig, keys, [&](size_t key) {
        return walk_pose(gait, static_cast<double>(key % kStrideKeys) / kStrideKeys);
    });
    Track way{person, {}, {}, {}};
    for (size_t key = 0; key <= keys; ++key) {
        const double lap = static_cast<double>(key) / static_cast<double>(keys);
        const glm::dquat heading = turn_about({0.0, 1.0, 0.0}, 360.0 * lap);
        way.rotations.push_back(heading);
        way.waypoints.push_back(
            {heading * dvec3(-gait.turn_radius, 0.0, 0.0), heading * dvec3(0.0, 0.0, speed)});
    }
    tracks.push_back(std::move(way));
    scene.add_clip("stroll", GltfScene::key_times(keys, gait.stride_seconds * kLapStrides), tracks);
}

void add_clips_in_place(GltfScene& scene, const Rig& rig) {
    const Gait gait;
    const auto step = [&](size_t key) {
        return walk_pose(gait, static_cast<double>(key) / kStrideKeys);
    };
    const auto stand = [](size_t key) { return idle_pose(static_cast<double>(key) / kIdleKeys); };
    scene.add_clip("walk", GltfScene::key_times(kStrideKeys, gait.stride_seconds),
                   GltfScene::tracks_of(rig, kStrideKeys, step));
    scene.add_clip("idle", GltfScene::key_times(kIdleKeys, kIdleSeconds),
                   GltfScene::tracks_of(rig, kIdleKeys, stand));
}

Json hair_look(Node body) {
    return {{"width", {{"root", 0.00026}, {"tip_scale", 0.4}}},
            {"binding", {{"mesh", body}}},
            {"motion", {{"bend_length", 0.08}, {"drag", 1.2}, {"hold", 0.35}}},
            {"material",
             {{"melanin", {{"eumelanin", 0.25}, {"pheomelanin", 0.3}}},
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
    const Gait gait;
    const Node person =
        scene.add_node({{"name", "person"},
                        {"translation", {-radius, 0.0, 0.0}},
                        {"extensions",
                         {{"VELLUS_player",
                           {{"idle", "idle"},
                            {"walk", "walk"},
                            {"speed", gait.stride_metres / gait.stride_seconds}}}}}});
    const Rig rig = scene.add_rig(figure_joints(), person);

    Json primitives = Json::array();
    for (const SkinnedPart& part : figure) {
        Json primitive = scene.add_geometry(part);
        primitive["material"] = scene.add_material(part.name, part.base_color, part.roughness);
        primitives.push_back(std::move(primitive));
    }
    const size_t skin = scene.add_skin(rig);
    const Node body = scene.add_node({{"name", "body"},
                                      {"mesh", scene.add_mesh("figure", std::move(primitives))},
                                      {"skin", skin}});
    scene.add_hair("hair", "walk.hair", kHeadMiddle - figure_joints()[kHead].position,
                   hair_look(body), rig.nodes[kHead]);
    add_figure_colliders(scene, rig);

    scene.add_ground({.path_radius = radius});
    scene.add_camera({1.00, 1.02, 2.75}, {0.05, 0.83, 0.05}, 0.68, person);
    // Where the default sky has its sun.
    scene.add_sun({0.45, 0.62, 0.64}, {1.0, 0.93, 0.82}, 3.2);
    add_lap(scene, rig, person);
    add_clips_in_place(scene, rig);
    return scene;
}

}  // namespace vellus::sculpt
