#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/platform/result.h"

namespace vellus::bench {

/// A head with hair under one kind of light, as the demo and the path tracer both open it.
struct TruthCase {
    std::string groom;
    std::string colour;
    std::string light;

    [[nodiscard]] std::string name() const { return groom + "_" + colour + "_" + light; }
};

constexpr std::array<std::string_view, 2> kTruthGrooms = {"straight", "wavy"};
constexpr std::array<std::string_view, 4> kTruthColours = {"black", "brown", "blond", "white"};
/// A sun before, beside or behind the head, or an environment alone: a sky over dim ground.
constexpr std::array<std::string_view, 4> kTruthLights = {"front", "side", "back", "sky"};

/// Grows the grooms and writes everything into `folder`, an existing one.
Result<void> write_truth_files(const std::filesystem::path& folder);
/// The scene of one case into `folder`, which write_truth_files() has filled: its path.
Result<std::filesystem::path> write_truth_scene(const std::filesystem::path& folder,
                                                const TruthCase& which);

}  // namespace vellus::bench
