#include "modules/hair/groom/load_strands.h"

#include <algorithm>

#include "engine/platform/log.h"
#include "modules/hair/groom/groom_file.h"
#include "modules/hair/groom/upright.h"

namespace vellus::hair {

namespace {

void log_report(const std::string& name, const GroomReport& report) {
    const std::string text = to_text(report);
    for (size_t start = 0; start < text.size();) {
        const size_t end = std::min(text.find('\n', start), text.size());
        log_info("{}: {}", name, text.substr(start, end - start));
        start = end + 1;
    }
}

}  // namespace

std::string strands_name(const std::filesystem::path& path, bool upright) {
    return path.string() + (upright ? "" : " (as in the file)");
}

Result<LoadedStrands> load_strands(const std::filesystem::path& path, bool upright) {
    auto loaded = load_groom(path);
    if (!loaded) return loaded.error();
    log_report(path.filename().string(), loaded->report);
    const Groom& groom = loaded->groom;
    glm::dmat4 to_metres(1.0);
    double metres_per_unit = 1.0;
    if (upright) {
        const Upright turn = upright_transform(groom);
        log_info("{}: {}", path.filename().string(), turn.reason);
        to_metres = turn.to_metres;
        metres_per_unit = turn.metres_per_unit;
    }
    const auto width = static_cast<float>(default_width(groom, metres_per_unit));
    return LoadedStrands{strands_name(path, upright), prepare_strands(groom, to_metres, width),
                         loaded->report};
}

}  // namespace vellus::hair
