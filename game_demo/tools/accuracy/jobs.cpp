#include "game_demo/tools/accuracy/jobs.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/platform/files.h"
#include "engine/platform/hash.h"
#include "game_demo/src/accuracy/budget.h"
#include "game_demo/tools/accuracy/transmittance.h"
#include "modules/hair/techniques.h"

namespace vellus::demo {

namespace {

using Names = std::vector<std::string>;

constexpr std::string_view kColourOfSettings = "brown";

/// Which pictures an axis is measured in.
struct AxisPictures {
    Names colours;
    Names lights;
};

Names names(std::span<const std::string_view> all) {
    return {all.begin(), all.end()};
}

/// Coverage and transmittance do not depend on the colour, so one is measured.
AxisPictures pictures_of(std::string_view axis, bool quick) {
    const Names colours = quick ? Names{"brown", "blond"} : names(kColours);
    const Names suns = quick ? Names{"front", "back"} : Names{"front", "side", "back"};
    if (axis == "opacity") return {{"white"}, {"environment"}};
    if (axis == "shadow") return {{"brown"}, suns};
    if (axis == "environment") return {colours, {"environment"}};
    if (axis == kFrameAxis) return {colours, {"outdoors"}};
    return {colours, suns};
}

/// Settings of an axis besides the demo's own; `quick` leaves out those that cost much to measure.
Names settings_of(std::string_view axis, std::string_view technique, bool quick) {
    const auto usual = hair::technique_id(hair::HairTechniques{}, axis);
    if (axis == "opacity" && technique == usual) {
        return quick ? Names{"", "taa=off", "detail=0.5"}
                     : Names{"", "taa=off", "detail=0.5", "detail=0.25"};
    }
    if (axis == "opacity") return {"", "taa=off"};
    if (technique == "none" || quick) return {""};
    if (axis == "shadow") {
        Names settings = {"", "map=256", "map=512", "map=1024"};
        if (technique == "pcf_exponential") {
            settings.insert(settings.end(), {"falloff=40", "falloff=160"});
        }
        return settings;
    }
    if (axis == "multiple") return {"", "map=256", "map=1024"};
    if (axis == "scattering") return {"", "roughness=0.2", "roughness=0.5"};
    return {""};
}

/// Technique and setting of each row of an axis.
using Variant = std::pair<std::string, std::string>;

std::vector<Variant> variants_of_axis(std::string_view axis, bool quick) {
    std::vector<Variant> variants;
    for (const std::string_view technique : hair::technique_ids(axis)) {
        if (technique == kTransmittance) continue;
        for (const auto& setting : settings_of(axis, technique, quick)) {
            variants.emplace_back(technique, setting);
        }
    }
    return variants;
}

/// The base, and every change of one axis that a frame's time or error may feel.
std::vector<Variant> variants_of_frame(bool quick) {
    std::vector<Variant> variants = {{kBase, ""}};
    for (const AxisChoice& usual : base_choices()) {
        const std::string& axis = usual.axis;
        auto changes = variants_of_axis(axis, true);
        if (axis == "shadow" && !quick) {
            for (const char* map : {"map=256", "map=1024"}) {
                changes.emplace_back(usual.technique, map);
            }
        }
        for (const auto& [technique, setting] : changes) {
            if (technique == usual.technique && setting.empty()) continue;
            if (quick && axis == "opacity" && setting == "taa=off" &&
                technique != usual.technique) {
                continue;
            }
            variants.emplace_back(fmt::format("{}={}", axis, technique), setting);
        }
        if (axis == "opacity") variants.emplace_back("opacity=" + usual.technique, "detail=0.25");
    }
    return variants;
}

/// A setting tells the same story in every colour, so one colour is measured; a frame's time and
/// error are predicted for each.
bool is_told_elsewhere(const std::string& axis, const AxisPictures& pictures,
                       const std::string& colour, const std::string& setting) {
    if (setting.empty() || axis == kFrameAxis || pictures.colours.size() == 1) return false;
    return colour != kColourOfSettings;
}

/// Of the program's own file: shaders are in it, so another build's results are not taken for this
/// one's. 0 where it cannot be read.
uint32_t program_fingerprint() {
    static const auto fingerprint = [] {
        const auto program = read_file("/proc/self/exe");
        return program ? static_cast<uint32_t>(fnv1a(*program)) : 0U;
    }();
    return fingerprint;
}

bool wanted(const Names& only, const std::string& name) {
    return only.empty() || std::ranges::find(only, name) != only.end();
}

void add_axis(const AccuracyOptions& options, const std::string& axis, std::vector<Job>& jobs) {
    const AxisPictures pictures = pictures_of(axis, options.quick);
    const auto variants = axis == kFrameAxis ? variants_of_frame(options.quick)
                                             : variants_of_axis(axis, options.quick);
    const Names grooms = options.quick ? Names{"straight", "curly"} : names(kGrooms);
    for (const std::string& groom : options.grooms.empty() ? grooms : options.grooms) {
        for (const std::string& colour : pictures.colours) {
            for (const std::string& light : pictures.lights) {
                if (!wanted(options.lights, light) || !wanted(options.colours, colour)) continue;
                for (const auto& [technique, setting] : variants) {
                    if (!wanted(options.techniques, technique)) continue;
                    if (is_told_elsewhere(axis, pictures, colour, setting)) continue;
                    const bool reference = axis == "scattering" && technique == "deon";
                    jobs.push_back({{groom, colour, light}, axis, technique, setting, reference});
                }
            }
        }
    }
}

}  // namespace

std::vector<std::string> measured_axes() {
    Names axes = names(hair::axes());
    axes.emplace_back(kFrameAxis);
    return axes;
}

std::string Job::id() const {
    std::string id = fmt::format("{}-{}", axis, technique);
    if (!setting.empty()) id += "-" + setting;
    id += fmt::format("-{}-{}-{}", subject.groom, subject.colour, subject.light);
    std::ranges::replace(id, '=', '.');
    return id;
}

JobSizes job_sizes(const AccuracyOptions& options) {
    JobSizes sizes;
    if (options.quick) {
        sizes = {.size = 128, .frames = 8, .warm_up = 32, .samples = 48, .strands = 3000};
    }
    if (options.size != 0) sizes.size = options.size;
    if (options.frames != 0) sizes.frames = options.frames;
    if (options.warm_up != 0) sizes.warm_up = options.warm_up;
    if (options.samples != 0) sizes.samples = options.samples;
    if (options.strands != 0) sizes.strands = options.strands;
    sizes.seed = options.seed;
    return sizes;
}

std::string describe(const JobSizes& sizes) {
    return fmt::format("size {} frames {}+{} spp {} strands {} seed {} program {:08x}", sizes.size,
                       sizes.warm_up, sizes.frames, sizes.samples, sizes.strands, sizes.seed,
                       program_fingerprint());
}

std::vector<Job> all_jobs(const AccuracyOptions& options) {
    std::vector<Job> jobs;
    for (const std::string& axis : measured_axes()) {
        if (wanted(options.axes, axis)) add_axis(options, axis, jobs);
    }
    std::ranges::stable_sort(jobs,
                             [](const Job& a, const Job& b) { return a.subject < b.subject; });
    return jobs;
}

std::vector<Job> jobs_of_shard(const std::vector<Job>& jobs, const Shard& shard) {
    std::vector<Job> mine;
    uint32_t subject = 0;
    for (size_t i = 0; i < jobs.size(); ++i) {
        if (i > 0 && jobs[i].subject != jobs[i - 1].subject) ++subject;
        if (subject % shard.count == shard.index) mine.push_back(jobs[i]);
    }
    return mine;
}

}  // namespace vellus::demo
