#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "engine/asset/scene_asset.h"
#include "engine/platform/result.h"
#include "modules/hair/cards/card_groom.h"

namespace vellus::hair {

/// On a node of the glTF file beside its mesh: which textures tell what of the hair. See README.md.
constexpr std::string_view kCardsExtensionName = "VELLUS_cards";

/// Whether the scene holds cards: triangles, and no strands.
bool holds_cards(const asset::SceneAsset& scene);

/// Whether a node says so itself (VELLUS_cards), which no ordinary scene does.
bool says_cards(const asset::SceneAsset& scene);

/// Cards of a glTF file: every triangle mesh of its scene, placed by its node, with one base colour
/// texture whose alpha is the opacity. Maps that VELLUS_cards names (PNG, relative to the file) are
/// optional: without one, tangents run along the card, depth is 0, and each card is one strand.
/// Errors name file, field and remedy.
Result<CardGroom> load_cards(const std::filesystem::path& path);
/// The same, or nothing where the file is no glTF or holds no cards.
Result<std::optional<CardGroom>> find_cards(const std::filesystem::path& path);
Result<CardGroom> cards_from_scene(const asset::SceneAsset& scene,
                                   const std::filesystem::path& path);

/// Writes NAME.gltf, NAME.bin and NAME_{color,tangent,depth,root,strand}.png; reading them gives
/// the same cards again. Any glTF viewer shows the mesh with its opacity. `path` ends in .gltf.
Result<void> save_cards(const CardGroom& cards, const std::filesystem::path& path);

}  // namespace vellus::hair
