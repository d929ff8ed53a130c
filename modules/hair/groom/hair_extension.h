#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/platform/result.h"
#include "modules/hair/dynamics/motion_extension.h"
#include "modules/hair/groom/hair_material.h"

namespace vellus::hair {

constexpr std::string_view kHairExtensionName = "VELLUS_hair";

/// The technique chosen on each axis by its id; empty: the module's default.
struct TechniqueIds {
    std::string opacity;
    std::string shadow;
    std::string scattering;
    std::string multiple;
    std::string environment;
};

/// The node whose mesh carries the roots: by index, else by name.
struct HairBindingChoice {
    std::optional<uint32_t> node;
    std::string name;
};

/// Cards to build from the strands when they are loaded; see cards/build_cards.h.
struct CardsChoice {
    uint32_t count = 0;  ///< 0: chosen for the strands
    float texels_per_metre = 0.0f;
    uint32_t max_texels = 1U << 22U;
};

/// VELLUS_hair on a glTF node: a groom file that moves with the node.
/// assets/schema/VELLUS_hair.schema.json is the format for people and editors.
struct HairExtension {
    /// Relative to the glTF file.
    std::string groom;
    /// Turn the groom upright and into metres by upright_transform() before the transform below.
    bool upright = true;
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    HairWidth width;
    HairMaterial material;
    TechniqueIds techniques;
    /// Empty: the groom moves rigidly with its node.
    std::optional<HairBindingChoice> binding;
    /// Empty: strands do not move on their own.
    std::optional<MotionChoice> motion;
    /// Empty: the file's strands, or its cards, as they are.
    std::optional<CardsChoice> cards;
    /// Unknown fields and clamped values, one line each; the caller logs them.
    std::vector<std::string> warnings;

    /// translation * rotation * scale.
    [[nodiscard]] glm::dmat4 transform() const;
};

/// Parses the extension's JSON. `where` names file and node in messages. A field of the wrong type
/// or outside its range is an Error that names the field and what is allowed; unknown fields are
/// warnings.
Result<HairExtension> parse_hair_extension(std::string_view json, const std::string& where);

}  // namespace vellus::hair
