#pragma once

#include <span>
#include <string>
#include <vector>

#include "assets/generator/gltf_scene.h"
#include "assets/generator/part.h"
#include "engine/platform/result.h"
#include "modules/hair/groom/groom.h"

namespace vellus::sculpt {

/// A groom of the crowd; `file` lies in grooms/.
struct CrowdGroom {
    std::string file;
    hair::Groom groom;
};

/// One head of hair for each of the nine, in their order: fewer and wider strands for those who
/// stand further away.
Result<std::vector<CrowdGroom>> grow_crowd_hair(const SkinnedPart& skin, const SkinnedPart& shirt);

/// Nine people in a park, near and far, each with other hair, clothes and moments of the clip.
GltfScene make_crowd_scene(const std::vector<SkinnedPart>& figure);

}  // namespace vellus::sculpt
