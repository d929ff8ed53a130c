#pragma once

#include <filesystem>

#include "engine/ecs/ecs.h"
#include "modules/hair/dynamics/motion_extension.h"
#include "modules/hair/groom/hair_extension.h"
#include "modules/light/load_environment.h"

namespace vellus::demo {

/// What content is loaded into: a world, and a keeper of the data its components refer to (a
/// device for the demo, plain columns for the reference).
class ContentHost {
  public:
    ContentHost() = default;
    virtual ~ContentHost() = default;
    ContentHost(const ContentHost&) = delete;
    ContentHost& operator=(const ContentHost&) = delete;

    virtual World& world() = 0;
    /// Size of the pictures from now on, pixels.
    virtual void resize(uint32_t width, uint32_t height) = 0;
    /// Lets the systems place everything once without drawing: bounds are known afterwards.
    virtual Result<void> settle() = 0;

    /// A groom file into the HairLibrary: its index there.
    virtual Result<uint32_t> add_groom(const std::filesystem::path& path,
                                       const hair::HairExtension& look) = 0;
    /// Binds a hair entity to a mesh entity.
    virtual Result<void> bind_hair(Entity hair, Entity mesh) = 0;
    /// Lets a hair entity's strands move.
    virtual Result<void> move_hair(Entity hair, const hair::MotionChoice& motion) = 0;
    /// The meshes of the SceneLibrary that are new.
    virtual Result<void> add_meshes() = 0;
    virtual Result<void> set_environment(const light::EnvironmentImage& image) = 0;
};

}  // namespace vellus::demo
