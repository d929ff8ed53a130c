#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "engine/ecs/ecs.h"
#include "engine/gpu/device.h"
#include "modules/hair/components.h"
#include "modules/hair/groom/groom_report.h"
#include "modules/hair/groom/hair_extension.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/techniques.h"

namespace vellus::hair {

/// The groom of that name in the world's HairLibrary.
std::optional<uint32_t> find_groom(const World& world, const std::string& name);

/// The points farthest along each of a few hundred directions; of very many points, a sample.
std::vector<glm::vec3> outermost_points(const std::vector<glm::vec3>& points);

/// All that the HairLibrary says of a groom but its buffers on the device.
LibraryGroom describe_groom(const std::string& name, const StrandData& strands,
                            const GroomReport& report);

/// Loads a groom into the world's HairLibrary and logs its report; the same file is loaded once.
/// `upright`: turn it upright and into metres (groom/upright.h).
Result<uint32_t> add_groom(World& world, gpu::Device& device, const std::filesystem::path& path,
                           bool upright);

/// The same as a scene asks for it: cards of the strands where `look` wants them.
Result<uint32_t> add_groom(World& world, gpu::Device& device, const std::filesystem::path& path,
                           const HairExtension& look);

/// Strands that are already in node space and metres, e.g. generated ones, into the HairLibrary.
Result<uint32_t> add_strands(World& world, gpu::Device& device, const std::string& name,
                             const StrandData& strands, const GroomReport& report);

/// Brings a groom file into the HairLibrary, on a device or not: its index there.
using AddGroom =
    std::function<Result<uint32_t>(const std::filesystem::path& path, const HairExtension& look)>;
/// Binds a hair entity to a mesh entity, as bind_hair.
using BindHair = std::function<Result<void>(Entity hair, Entity mesh)>;
/// Lets the strands of a hair entity move, as add_motion.
using MoveHair = std::function<Result<void>(Entity hair, const MotionChoice& motion)>;

/// What keeps the data that hair entities refer to.
struct HairKeeper {
    AddGroom add_groom;
    BindHair bind;
    MoveHair move;  ///< empty: hair stays as loaded
};

/// An entity that wears hair: a child of `parent` (kNoEntity: a root).
Result<Entity> spawn_hair(World& world, const AddGroom& add, const std::filesystem::path& path,
                          const HairExtension& look, Entity parent);
Result<Entity> spawn_hair(World& world, gpu::Device& device, const std::filesystem::path& path,
                          const HairExtension& look, Entity parent);

/// The same with a groom of the HairLibrary.
Entity spawn_hair(World& world, uint32_t groom, const HairExtension& look,
                  const HairTechniques& techniques, Entity parent);

/// Hair of every node of the instance that has VELLUS_hair, and colliders of those that have
/// VELLUS_collider; grooms are relative to its file.
Result<void> spawn_scene_hair(World& world, const HairKeeper& keeper, uint32_t instance);
Result<void> spawn_scene_hair(World& world, gpu::Device& device, uint32_t instance);

}  // namespace vellus::hair
