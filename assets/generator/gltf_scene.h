#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "assets/generator/body_colliders.h"
#include "assets/generator/gltf_buffer.h"
#include "assets/generator/gltf_values.h"
#include "assets/generator/ground.h"
#include "assets/generator/part.h"
#include "assets/generator/skeleton.h"

namespace vellus::sculpt {

/// Numbers of glTF nodes.
using Node = size_t;
constexpr Node kNoNode = static_cast<Node>(-1);

/// A skeleton placed in a scene: one node per joint, in the order of the joints.
struct Rig {
    std::span<const Joint> joints;
    std::vector<Node> nodes;
};

/// A place, and the speed there in metres a second.
struct Waypoint {
    glm::dvec3 position;
    glm::dvec3 velocity;
};

/// What a clip does to one node, key by key: a rotation, a place; waypoints are joined by cubics
/// instead of straight lines.
struct Track {
    Node node;
    std::vector<glm::dquat> rotations;
    std::vector<glm::dvec3> translations;
    std::vector<Waypoint> waypoints;
};

/// A glTF scene while it is put together.
class GltfScene {
  public:
    explicit GltfScene(std::string name);

    Node add_node(Json node, Node parent = kNoNode);
    /// Nodes for a skeleton below `parent`, at rest.
    Rig add_rig(std::span<const Joint> joints, Node parent, const std::string& prefix = {});
    /// Column data of a part, to be used by any number of meshes: its attributes and indices.
    Json add_geometry(const SkinnedPart& part);
    size_t add_material(const std::string& name, glm::dvec3 base_color, double roughness);
    size_t add_mesh(const std::string& name, Json primitives);
    /// A skin of the rig, whose joints are at rest where the model was sculpted.
    size_t add_skin(const Rig& rig);
    /// Keys at these times in seconds, increasing.
    void add_clip(const std::string& name, std::span<const double> times,
                  std::span<const Track> tracks);
    /// Times of `keys` + 1 keys that divide `seconds` evenly, from 0.
    static std::vector<double> key_times(size_t keys, double seconds);
    /// Joint tracks of a clip whose keys are `pose(0)` to `pose(keys)`.
    static std::vector<Track> tracks_of(const Rig& rig, size_t keys,
                                        const std::function<Pose(size_t)>& pose);
    Node add_ground(const Ground& ground);
    Node add_camera(glm::dvec3 eye, glm::dvec3 target, double vertical_fov, Node parent = kNoNode);
    /// A groom beside the scene, made by to_groom(): where sculpting space lies in the node's. The
    /// extension's other fields come from `look`.
    Node add_hair(const std::string& name, const std::string& groom, glm::dvec3 place,
                  const Json& look, Node parent);
    /// A VELLUS_collider below `joint`, whose place and the capsule's are in the same space.
    Node add_collider(const BodyCapsule& capsule, glm::dvec3 joint_at, Node joint);
    Node add_sun(glm::dvec3 to_sun, glm::dvec3 color, double intensity);

    [[nodiscard]] const std::string& name() const { return name_; }
    /// The .gltf text and its buffer, called NAME.bin.
    [[nodiscard]] std::string json() const;
    [[nodiscard]] const std::vector<std::byte>& buffer() const { return buffer_.bytes(); }

  private:
    std::string name_;
    GltfBuffer buffer_;
    Json roots_ = Json::array();
    Json nodes_ = Json::array();
    Json meshes_ = Json::array();
    Json materials_ = Json::array();
    Json skins_ = Json::array();
    Json clips_ = Json::array();
    Json cameras_ = Json::array();
    Json lights_ = Json::array();
};

}  // namespace vellus::sculpt
