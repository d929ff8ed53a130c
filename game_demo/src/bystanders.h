#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/ecs/ecs.h"

namespace vellus::demo {

/// Everyone with a skeleton but the walker: who walks does not walk through them.
class Bystanders {
  public:
    Bystanders() = default;
    Bystanders(World& world, Entity walker);

    /// `feet` moved aside, over the ground, to an arm's length from everyone.
    [[nodiscard]] glm::dvec3 clear_of(World& world, const glm::dvec3& feet) const;

  private:
    /// The joints of each skeleton; their middle is where it stands.
    std::vector<std::vector<Entity>> skeletons_;
};

}  // namespace vellus::demo
