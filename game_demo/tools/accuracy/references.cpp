#include "game_demo/tools/accuracy/references.h"

#include <fmt/format.h>

#include "engine/asset/image_planes.h"
#include "engine/platform/hash.h"
#include "game_demo/tools/accuracy/transmittance.h"

namespace vellus::demo {

namespace {

constexpr uint32_t kSupersample = 8;  // a side
constexpr uint32_t kVisibleRays = 64;
constexpr uint32_t kShortWarmUp = 2;
constexpr const char* kBestScattering = "deon";

/// "AXIS=TECHNIQUE" of a job on the frame axis, or its own axis and technique.
AxisChoice choice_of(const Job& job) {
    if (job.axis != kFrameAxis) return {job.axis, job.technique, job.setting};
    const size_t equals = job.technique.find('=');
    if (equals == std::string::npos) return {};
    return {job.technique.substr(0, equals), job.technique.substr(equals + 1), job.setting};
}

asset::PlaneImage to_planes(const Reference& reference) {
    const size_t pixels = reference.weight.size();
    asset::PlaneImage image{reference.picture.size.x, reference.picture.size.y, {}};
    for (const char* name : {"R", "G", "B"}) {
        image.planes.push_back({name, std::vector<float>(pixels)});
    }
    for (size_t i = 0; i < pixels; ++i) {
        for (int c = 0; c < 3; ++c) image.planes[c].values[i] = reference.picture.pixels[i][c];
    }
    image.planes.push_back({"weight", reference.weight});
    image.planes.push_back(
        {"noise", std::vector<float>(pixels, static_cast<float>(reference.noise))});
    image.planes.push_back(
        {"block", std::vector<float>(pixels, static_cast<float>(reference.block))});
    return image;
}

std::optional<Reference> from_planes(const asset::PlaneImage& image, uint32_t size) {
    std::array<const asset::Plane*, 6> planes{};
    size_t found = 0;
    for (const char* name : {"R", "G", "B", "weight", "noise", "block"}) {
        planes[found++] = image.find(name);
    }
    if (std::ranges::find(planes, nullptr) != planes.end()) return std::nullopt;
    if (image.width != size || image.height != size) return std::nullopt;
    Reference reference{.picture = {glm::uvec2(size), {}}, .weight = planes[3]->values};
    for (size_t i = 0; i < reference.weight.size(); ++i) {
        reference.picture.pixels.emplace_back(planes[0]->values[i], planes[1]->values[i],
                                              planes[2]->values[i]);
    }
    reference.noise = static_cast<double>(planes[4]->values[0]);
    reference.block = std::max(static_cast<uint32_t>(planes[5]->values[0]), 1u);
    return reference;
}

/// Mean of square blocks.
Radiance shrink(const Radiance& large, uint32_t factor) {
    Radiance small{large.size / factor, {}};
    small.pixels.resize(size_t{small.size.x} * small.size.y);
    for (uint32_t y = 0; y < small.size.y * factor; ++y) {
        for (uint32_t x = 0; x < small.size.x * factor; ++x) {
            small.pixels[size_t{y / factor} * small.size.x + x / factor] +=
                large.pixels[size_t{y} * large.size.x + x] / static_cast<float>(factor * factor);
        }
    }
    return small;
}

Reference grey(const std::vector<float>& values, std::vector<float> weight, uint32_t size) {
    Reference reference{.picture = {glm::uvec2(size), {}}, .weight = std::move(weight)};
    for (const float value : values) reference.picture.pixels.emplace_back(value);
    return reference;
}

}  // namespace

FrameRun frame_run(const Job& job, const JobSizes& sizes) {
    FrameRun run{.look = {job.subject.colour, job.subject.light},
                 .size = sizes.size,
                 .warm_up = sizes.warm_up,
                 .frames = sizes.frames,
                 .seed = sizes.seed};
    // Where the history is no part of what is measured, the mean of the frames takes its place.
    if (job.axis != "opacity") {
        run.blend = 1.0f;
        run.warm_up = kShortWarmUp;
    }
    if (job.axis == "opacity") {
        run.look.coverage = true;
        run.choices = {{"shadow", "none", ""}};
    }
    // Transmittance is a ratio of two pictures whose pixels show the same segment: no history, and
    // nothing but what arrives.
    if (job.axis == "shadow") {
        run.temporal = false;
        run.choices = {{"multiple", "none", ""}, {"scattering", kTransmittance, ""}};
    }
    if (job.axis == "scattering") run.choices = {{"multiple", "none", ""}};
    if (job.axis == kFrameAxis) run.choices = base_choices();
    // Scattered light is as near as the shadows it starts from.
    if (job.axis == "multiple") {
        run.choices = {{"scattering", "series_b", ""}, {"shadow", "deep_opacity", ""}};
    }
    if (const AxisChoice choice = choice_of(job); !choice.axis.empty()) {
        run.choices.push_back(choice);
    }
    return run;
}

std::string References::name(const Job& job) {
    const std::string about =
        fmt::format("{}-{}-{}", job.subject.groom, job.subject.colour, job.subject.light);
    if (job.axis == "opacity") return "coverage-" + job.subject.groom;
    if (job.axis == "shadow") {
        return fmt::format("transmittance-{}-{}", job.subject.groom, job.subject.light);
    }
    if (job.axis != "scattering") return "traced-" + about;
    // A material of its own needs a picture of its own.
    std::string name = "deon-" + about;
    if (!job.setting.empty()) name += "-" + job.setting;
    std::ranges::replace(name, '=', '.');
    return name;
}

std::filesystem::path References::file(const std::string& name) const {
    const std::string all = describe(sizes_) + device_.traits().name;
    const uint64_t hash = fnv1a(std::as_bytes(std::span(all)));
    return folder_ / fmt::format("{}-{:08x}.exr", name, static_cast<uint32_t>(hash));
}

Result<const StudioGroom*> References::groom(const std::string& name) {
    if (const auto found = grooms_.find(name); found != grooms_.end()) return &found->second;
    auto grown = grow_studio_groom(name, sizes_.strands, sizes_.seed);
    if (!grown) return grown.error();
    return &grooms_.emplace(name, std::move(*grown)).first->second;
}

Result<const Reference*> References::find(const Job& job) {
    if (job.subject != subject_) made_.clear();
    subject_ = job.subject;
    const std::string key = name(job);
    if (const auto found = made_.find(key); found != made_.end()) return &found->second;
    std::error_code code;
    const auto path = file(key);
    if (std::filesystem::exists(path, code)) {
        if (const auto planes = asset::load_planes(path)) {
            if (auto known = from_planes(*planes, sizes_.size)) {
                return &made_.emplace(key, std::move(*known)).first->second;
            }
        }
    }
    auto made = make(job);
    if (!made) return made.error();
    if (auto saved = asset::save_planes(path, to_planes(*made)); !saved) return saved.error();
    return &made_.emplace(key, std::move(*made)).first->second;
}

Result<Reference> References::make(const Job& job) {
    auto grown = groom(job.subject.groom);
    if (!grown) return grown.error();
    const FrameRun run = frame_run(job, sizes_);
    if (job.axis == "opacity") return supersampled(**grown);
    if (job.axis == "shadow") return exact_shadow(**grown, run.look);
    if (job.axis == "scattering") return best_technique(**grown, job);
    auto scene = trace_scene(**grown, run.look, sizes_.size);
    if (!scene) return scene.error();
    return path_traced(std::move(*scene), sizes_.size, sizes_.samples, sizes_.seed, stop_);
}

Result<Reference> References::supersampled(const StudioGroom& groom) {
    const FrameRun run{.look = {.colour = "white", .light = "environment", .coverage = true},
                       .size = sizes_.size * kSupersample,
                       .frames = 1,
                       .temporal = false,
                       .choices = {{"opacity", "dither_still", ""}, {"shadow", "none", ""}}};
    auto drawn = draw_frames(device_, groom, run);
    if (!drawn) return drawn.error();
    Reference reference{.picture = shrink(drawn->pictures[0], kSupersample)};
    reference.weight.assign(reference.picture.pixels.size(), 1.0f);
    return reference;
}

Result<Reference> References::exact_shadow(const StudioGroom& groom, const StudioLook& look) {
    auto scene = trace_scene(groom, look, sizes_.size);
    if (!scene) return scene.error();
    auto visible = trace_visible(*scene, sizes_.size, kVisibleRays, sizes_.seed);
    if (!visible) return visible.error();
    Reference reference = grey(visible->transmittance, std::move(visible->share), sizes_.size);
    // Rays say yes or no, and a frame shows one strand a pixel: both have noise of their own.
    reference.block = kTracedBlock;
    return reference;
}

Result<Reference> References::best_technique(const StudioGroom& groom, const Job& job) {
    Job best = job;
    best.technique = kBestScattering;
    auto drawn = draw_frames(device_, groom, frame_run(best, sizes_));
    if (!drawn) return drawn.error();
    auto scene = trace_scene(groom, {job.subject.colour, job.subject.light}, sizes_.size);
    if (!scene) return scene.error();
    auto visible = trace_visible(*scene, sizes_.size, kVisibleRays, sizes_.seed);
    if (!visible) return visible.error();
    return Reference{.picture = mean_of(drawn->pictures), .weight = std::move(visible->share)};
}

}  // namespace vellus::demo
