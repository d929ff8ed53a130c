#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assets/generator/bust_mesh.h"

namespace vellus::sculpt {

/// The default scene as glTF: `json` refers to the buffer as portrait.bin and to the grooms beside
/// it.
struct Portrait {
    std::string json;
    std::vector<std::byte> buffer;
};

/// The bust skinned to torso, neck and head, its hair on the head joint, a turn of the head that
/// repeats every eight seconds, a camera, a sun and a rim light.
Portrait make_portrait(const std::vector<Part>& parts);

}  // namespace vellus::sculpt
