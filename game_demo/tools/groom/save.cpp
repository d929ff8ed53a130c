#include "game_demo/tools/groom/save.h"

#include <fmt/ostream.h>

#include "modules/hair/groom/convert.h"

namespace vellus::groom_tool {

Result<void> check_target(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".hair" || extension == ".tfx" || extension == ".glb") return {};
    return Error{fmt::format("cannot write a groom as '{}'", extension), path.string(),
                 "name it .hair, .tfx or .glb"};
}

Result<void> save(const hair::Groom& groom, const std::filesystem::path& path, bool keep_axes,
                  std::ostream& out) {
    const auto target = hair::format_of_extension(path.extension().string());
    const hair::ConvertedGroom converted = hair::convert_groom(groom, target, keep_axes);
    for (const std::string& note : converted.notes) fmt::print(out, "{}\n", note);
    if (auto saved = hair::save_groom(converted.groom, path); !saved) return saved;
    fmt::print(out, "{}: {} strands, {} points, {} bytes\n", path.string(),
               converted.groom.strand_count(), converted.groom.points.size(),
               std::filesystem::file_size(path));
    return {};
}

}  // namespace vellus::groom_tool
