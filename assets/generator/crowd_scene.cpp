#include "assets/generator/crowd_scene.h"

#include <array>

#include "assets/generator/figure.h"
#include "assets/generator/figure_colliders.h"
#include "assets/generator/ground.h"
#include "assets/generator/random.h"
#include "assets/generator/trigonometry.h"
#include "assets/generator/walk_cycle.h"

namespace vellus::sculpt {

namespace {

using glm::dvec3;

constexpr size_t kKeys = 48;
constexpr double kSeconds = 8.0;
constexpr size_t kStrideKeys = 32;
/// Whom the user walks: in front of everybody, with hair that moves.
constexpr size_t kPlayer = 1;

struct Person {
    double x, z, yaw, scale;
    dvec3 skin, shirt, trousers;
    double eumelanin, pheomelanin;
    /// Diameter of a strand at the root in metres.
    double width;
    /// Cards that stand for the strands; 0: the strands themselves, in motion.
    int cards;
};

// From the front row's left to the back row's right.
// clang-format off
constexpr std::array<Person, 9> kPeople = {{
    {-0.80, 0.55, 16.0, 1.00, {1.0, 1.0, 1.0}, {0.10, 0.25, 0.30}, {0.16, 0.14, 0.13}, 0.16, 0.75, 0.0008, 0},
    {0.02, 0.80, -4.0, 0.97, {0.62, 0.50, 0.42}, {0.72, 0.55, 0.16}, {0.05, 0.08, 0.15}, 1.7, 0.4, 0.0012, 0},
    {0.82, 0.50, -20.0, 1.03, {1.0, 0.97, 0.94}, {0.36, 0.08, 0.10}, {0.35, 0.30, 0.24}, 0.08, 0.09, 0.0008, 0},
    {-2.05, -0.75, 22.0, 0.98, {0.95, 0.90, 0.80}, {0.55, 0.55, 0.58}, {0.03, 0.03, 0.04}, 6.0, 0.1, 0.0012, 40},
    {-0.75, -0.80, 8.0, 1.02, {0.85, 0.76, 0.70}, {0.45, 0.16, 0.30}, {0.08, 0.12, 0.22}, 0.7, 0.4, 0.0012, 40},
    {0.50, -0.72, -8.0, 1.04, {0.36, 0.27, 0.22}, {0.12, 0.32, 0.14}, {0.28, 0.25, 0.20}, 7.0, 0.1, 0.0024, 60},
    {1.90, -0.95, -24.0, 1.05, {0.98, 0.92, 0.88}, {0.10, 0.12, 0.30}, {0.14, 0.13, 0.12}, 0.10, 0.02, 0.0022, 50},
    {-2.35, -2.60, 18.0, 0.96, {1.0, 0.95, 0.90}, {0.75, 0.70, 0.62}, {0.20, 0.07, 0.07}, 0.2, 0.2, 0.0015, 30},
    {0.15, -2.90, -2.0, 1.06, {0.75, 0.64, 0.55}, {0.08, 0.30, 0.42}, {0.05, 0.06, 0.07}, 0.9, 0.6, 0.0024, 40},
}};
// clang-format on

/// Each breathes and looks about at a moment of their own; every other one stands the other way
/// round.
Pose pose_of(size_t person, double phase) {
    const auto key = static_cast<uint32_t>(person);
    Pose pose = idle_pose(phase + random(key, 101));
    const auto turn = [&](int joint, glm::dquat by) {
        glm::dquat& q = pose.rotations[static_cast<size_t>(joint)];
        q = by * q;
    };
    turn(kNeck, tilt(2.0 * spread(key, 102), 6.0 * spread(key, 103), 3.0 * spread(key, 104)));
    turn(kHead, tilt(2.0 * spread(key, 105), 7.0 * spread(key, 106), 3.0 * spread(key, 107)));
    turn(kLeftForearm,
         turn_about(glm::cross(arm_direction(), dvec3(0.0, 0.0, 1.0)), 25.0 * random(key, 108)));
    return pose;
}

Rig add_person(GltfScene& scene, size_t index, const std::vector<Json>& geometry,
               const std::vector<size_t>& shared_materials) {
    const Person& who = kPeople[index];
    const std::string number = std::to_string(index + 1);
    Json place = {{"name", "person_" + number},
                  {"translation", {who.x, 0.0, who.z}},
                  {"rotation", list(turn_about({0.0, 1.0, 0.0}, who.yaw))},
                  {"scale", {who.scale, who.scale, who.scale}}};
    if (index == kPlayer) {
        const Gait gait;
        place["extensions"]["VELLUS_player"] = {
            {"idle", "idle"},
            {"walk", "walk"},
            {"speed", who.scale * gait.stride_metres / gait.stride_seconds}};
    }
    const Node node = scene.add_node(place);
    Rig rig = scene.add_rig(figure_joints(), node, number + "_");
    Json look = {{"width", {{"root", who.width}, {"tip_scale", 0.45}}},
                 {"material",
                  {{"melanin", {{"eumelanin", who.eumelanin}, {"pheomelanin", who.pheomelanin}}},
                   {"color_variation", 0.2},
                   {"roughness", 0.32}}}};
    if (who.cards > 0) {
        look["cards"] = {{"count", who.cards}, {"max_texels", 131072}};
    } else {
        look["motion"] = {{"bend_length", 0.08}, {"drag", 1.2}, {"hold", 0.35}};
        add_figure_colliders(scene, rig);
    }
    scene.add_hair("hair_" + number, "crowd_" + number + ".hair",
                   kHeadMiddle - figure_joints()[kHead].position, look, rig.nodes[kHead]);
    const std::array<size_t, 5> materials = {
        scene.add_material("skin_" + number, who.skin, 0.55),
        scene.add_material("shirt_" + number, who.shirt, 0.9),
        scene.add_material("trousers_" + number, who.trousers, 0.9), shared_materials[0],
        shared_materials[1]};
    Json primitives = Json::array();
    for (size_t part = 0; part < geometry.size(); ++part) {
        primitives.push_back(geometry[part]);
        primitives.back()["material"] = materials[part];
    }
    const size_t skin = scene.add_skin(rig);
    scene.add_node({{"name", "body_" + number},
                    {"mesh", scene.add_mesh("figure_" + number, std::move(primitives))},
                    {"skin", skin}});
    return rig;
}

/// Everybody at ease, and the player's walk in place.
void add_clips(GltfScene& scene, const std::vector<Rig>& rigs) {
    std::vector<Track> tracks;
    for (size_t person = 0; person < rigs.size(); ++person) {
        for (Track& track : GltfScene::tracks_of(rigs[person], kKeys, [&](size_t key) {
                 return pose_of(person, static_cast<double>(key) / kKeys);
             })) {
            tracks.push_back(std::move(track));
        }
    }
    scene.add_clip("idle", GltfScene::key_times(kKeys, kSeconds), tracks);
    const Gait gait;
    scene.add_clip("walk", GltfScene::key_times(kStrideKeys, gait.stride_seconds),
                   GltfScene::tracks_of(rigs[kPlayer], kStrideKeys, [&](size_t key) {
                       return walk_pose(gait, static_cast<double>(key) / kStrideKeys);
                   }));
}

}  // namespace

GltfScene make_crowd_scene(const std::vector<SkinnedPart>& figure) {
    GltfScene scene("crowd");
    std::vector<Json> geometry;
    geometry.reserve(figure.size());
    for (const SkinnedPart& part : figure) {
        geometry.push_back(scene.add_geometry(part));
    }
    const std::vector<size_t> shared = {
        scene.add_material("shoes", figure[3].base_color, figure[3].roughness),
        scene.add_material("eyes", figure[4].base_color, figure[4].roughness)};
    std::vector<Rig> rigs;
    for (size_t person = 0; person < kPeople.size(); ++person) {
        rigs.push_back(add_person(scene, person, geometry, shared));
    }
    scene.add_ground({.path_radius = 5.0, .path_width = 1.6, .center = {0.0, 0.0, 1.2}});
    scene.add_camera({0.38, 1.48, 4.35}, {0.02, 0.93, -0.60}, 0.62);
    scene.add_sun({0.45, 0.62, 0.64}, {1.0, 0.93, 0.82}, 3.2);
    add_clips(scene, rigs);
    return scene;
}

}  // namespace vellus::sculpt
