#pragma once

#include <string>
#include <vector>

#include "engine/platform/result.h"
#include "modules/hair/groom/groom.h"

namespace vellus::hair {

/// A groom as another format would hold it, and what that format has no place for.
struct ConvertedGroom {
    Groom groom;
    /// One line each: what was lost or changed.
    std::vector<std::string> notes;
};

/// Axes, unit, colours and columns by the conventions of `target`: .hair is Z up, faces -Y, in
/// centimetres, sRGB; .tfx is Y up in metres, sRGB; glTF Y up in metres, linear. A groom that is of
/// `target` already keeps its axes and numbers. What comes back survives writing and reading bit
/// for bit. `keep_axes`: positions and diameters stay as they are in any case.
ConvertedGroom convert_groom(const Groom& groom, GroomFormat target, bool keep_axes = false);

/// Strands of `points` points each, evenly spaced by arc length; columns follow. `points` >= 2.
Groom resample_groom(const Groom& groom, uint32_t points);

/// The format that a file name's extension stands for: .hair, .tfx (4.0), .glb, .gltf.
GroomFormat format_of_extension(const std::string& extension);
const char* format_name(GroomFormat format);

}  // namespace vellus::hair
