#pragma once

#include <functional>
#include <string>

#include "game_demo/src/content_host.h"
#include "game_demo/tools/accuracy/jobs.h"
#include "modules/hair/groom/groom_report.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/grow/surface.h"

namespace vellus::demo {

/// Hair on a ball, as it is photographed.
struct StudioGroom {
    std::string name;
    hair::StrandData strands;
    hair::GroomReport report;
    hair::GrowSurface ball;
};
/// Grows it; `name` is one of kGrooms. The same strands for the same name, count and seed. Fewer
/// strands than a head has are wider, so that they cover about the same.
Result<StudioGroom> grow_studio_groom(const std::string& name, uint32_t strands, uint64_t seed);

/// What colour and light it is photographed in.
struct StudioLook {
    std::string colour;
    std::string light;
    /// White hair alone, under an even white sky: unshadowed its brightness is coverage.
    bool coverage = false;
};

/// Linear colour of kColours.
glm::vec3 studio_colour(const std::string& name);

/// Brings strands into the HairLibrary of a host: their index there.
using AddStrands = std::function<Result<uint32_t>(const StudioGroom& groom)>;

/// Groom, ball, light and camera into an empty world, placed; the hair entity. What is behind them
/// is black in the device's pictures once environment.drawn is off.
Result<Entity> set_up_studio(ContentHost& host, const AddStrands& add, const StudioGroom& groom,
                             const StudioLook& look, uint32_t size);

}  // namespace vellus::demo
