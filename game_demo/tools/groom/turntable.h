#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "engine/asset/image.h"
#include "game_demo/src/options.h"

namespace vellus::groom_tool {

/// Pictures of a groom from all sides.
struct Turntable {
    std::filesystem::path groom;
    std::filesystem::path scene;  ///< empty: the groom on its own
    /// The node of the scene that carries the groom; hair it has already is replaced, its look
    /// kept.
    std::string node;
    bool in_node_space = false;  ///< the groom's coordinates are the node's, not the scene's
    bool as_is = false;          ///< not turned upright nor into metres
    std::optional<glm::vec3> color;
    float tip_scale = -1.0f;  ///< width left at the tip; negative: as it is
    uint32_t views = 8;
    double pitch = 0.08;  ///< radians from above
    double zoom = 1.0;
    uint32_t frames = 48;  ///< drawn of each view, so that it converges
    std::filesystem::path out = "out";
    bool sheet = false;  ///< all views in one picture as well
    demo::Options renderer;
};

/// Writes DIR/view_NN.png, and DIR/sheet.png where asked for.
Result<void> write_turntable(const Turntable& turntable);

/// Pictures of one size side by side, `columns` to a row.
asset::Image make_sheet(const std::vector<asset::Image>& pictures, uint32_t columns);

}  // namespace vellus::groom_tool
