#include "game_demo/tools/accuracy/measure.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "game_demo/tools/accuracy/flip.h"
#include "game_demo/tools/accuracy/pictures.h"
#include "game_demo/tools/accuracy/transmittance.h"

namespace vellus::demo {

namespace {

double mean_single_error(const DrawnFrames& drawn, const Reference& reference) {
    double total = 0.0;
    for (const Radiance& frame : drawn.pictures) total += relative_l1(frame, reference);
    return total / static_cast<double>(drawn.pictures.size());
}

double weighted_mean(const std::vector<float>& values, const std::vector<float>& weight) {
    double above = 0.0;
    double below = 0.0;
    for (size_t i = 0; i < values.size(); ++i) {
        above += static_cast<double>(weight[i] * values[i]);
        below += static_cast<double>(weight[i]);
    }
    return below > 0.0 ? above / below : 0.0;
}

/// How pictures of an axis are shown: coverage and transmittance as they are, light exposed.
float exposure_of(const Job& job, const Reference& reference) {
    return job.axis == "opacity" || job.axis == "shadow" ? 0.0f : exposure_for(reference);
}

/// Brightness of full coverage becomes 1.
void normalise_coverage(const Reference& from, Radiance& picture) {
    float most = 1e-6f;
    for (const glm::vec3& c : from.picture.pixels) most = std::max(most, c.y);
    for (glm::vec3& c : picture.pixels) c /= most;
}

void add_figures(const Job& job, const DrawnFrames& drawn, const Radiance& mean,
                 const Reference& reference, AccuracyRow& row) {
    row.measures = {{"l1", relative_l1(mean, reference)},
                    {"l2", relative_l2(mean, reference)},
                    {"bias", relative_bias(mean, reference)},
                    {"flicker", flicker(drawn.pictures, reference)},
                    {"cpu_ms", spread_of(drawn.cpu_ms).median}};
    if (reference.noise > 0.0) row.measures["reference_noise"] = reference.noise;
    row.error = row.measures["l1"];
    if (job.axis == "opacity") row.error = mean_single_error(drawn, reference);
    if (job.axis == "shadow") row.error = mean_difference(mean, reference);
    row.axis_ms = spread_of(axis_times(drawn, job.axis));
    row.frame_ms = spread_of(frame_times(drawn));
    row.transient_bytes = drawn.transient_bytes;
    row.persistent_bytes = drawn.persistent_bytes;
    row.frames = static_cast<uint32_t>(drawn.pictures.size());
}

}  // namespace

Measure::Measure(gpu::Device& device, std::filesystem::path out, const JobSizes& sizes,
                 const std::atomic<bool>& stop)
    : device_(device),
      out_(std::move(out)),
      sizes_(sizes),
      references_(device, out_ / "references", sizes, stop) {}

std::filesystem::path Measure::row_file(const Job& job) const {
    return out_ / "jobs" / (job.id() + ".json");
}

bool Measure::is_of_this_run(const AccuracyRow& row) const {
    return row.run == describe(sizes_) && row.device == device_.traits().name;
}

Result<DrawnFrames> Measure::draw(const Job& job) {
    auto groom = references_.groom(job.subject.groom);
    if (!groom) return groom.error();
    if (auto added = add_transmittance(); !added) return added.error();
    return draw_frames(device_, **groom, frame_run(job, sizes_));
}

/// The frames of a job of axis shadow without any shadow.
Result<const std::vector<Radiance>*> Measure::unshadowed(const Job& job) {
    const std::string of = job.subject.groom + job.subject.colour + job.subject.light;
    if (unshadowed_of_ != of) {
        Job bare = job;
        bare.technique = "none";
        bare.setting.clear();
        auto drawn = draw(bare);
        if (!drawn) return drawn.error();
        unshadowed_ = std::move(drawn->pictures);
        unshadowed_of_ = of;
    }
    return &unshadowed_;
}

Result<void> Measure::save_pictures(const Job& job, const Radiance& mean,
                                    const Reference& reference, AccuracyRow& row) {
    const float exposure = exposure_of(job, reference);
    Radiance picture = mean;
    Radiance truth = reference.picture;
    if (job.axis == "opacity") {
        normalise_coverage(reference, picture);
        normalise_coverage(reference, truth);
    }
    const auto shown = displayed(picture, exposure);
    const auto shown_truth = displayed(truth, exposure);
    const auto errors = flip(shown, shown_truth, mean.size);
    row.measures["flip"] = weighted_mean(errors, reference.weight);
    std::vector<float> differences = errors;
    if (job.axis == "opacity" || job.axis == "shadow") {
        for (size_t i = 0; i < differences.size(); ++i) {
            differences[i] = std::abs(shown[i].y - shown_truth[i].y);
            if (reference.weight[i] <= 0.0f) differences[i] = 0.0f;
        }
    }
    row.pictures = {"jobs/" + row.id + ".picture.png",
                    "references/" + References::name(job) + ".png",
                    "jobs/" + row.id + ".difference.png"};
    const std::array images = {to_image(shown, mean.size), to_image(shown_truth, mean.size),
                               heat_map(differences, mean.size)};
    for (size_t i = 0; i < images.size(); ++i) {
        if (auto saved = asset::save_png(out_ / row.pictures[i], images[i]); !saved) return saved;
    }
    return {};
}

Result<AccuracyRow> Measure::run(const Job& job) {
    auto found = references_.find(job);
    if (!found) return found.error();
    Reference reference = **found;
    auto drawn = draw(job);
    if (!drawn) return drawn.error();
    if (job.axis == "shadow") {
        auto bare = unshadowed(job);
        if (!bare) return bare.error();
        to_transmittance(**bare, drawn->pictures, reference.weight);
    }
    const Radiance mean = mean_of(drawn->pictures);
    AccuracyRow row{.id = job.id(),
                    .axis = job.axis,
                    .technique = job.technique,
                    .setting = job.setting,
                    .groom = job.subject.groom,
                    .colour = job.subject.colour,
                    .light = job.subject.light,
                    .device = device_.traits().name,
                    .run = describe(sizes_),
                    .reference = job.reference};
    add_figures(job, *drawn, mean, reference, row);
    if (auto saved = save_pictures(job, mean, reference, row); !saved) return saved.error();
    auto written = write_file(row_file(job), std::string_view(row_json(row).dump(1) + "\n"));
    if (!written) return written.error();
    return row;
}

Result<Combination> Measure::run_combination(const Subject& subject,
                                             std::vector<AxisChoice> choices) {
    const Job job{subject, kFrameAxis, kBase, "", false};
    auto reference = references_.find(job);
    if (!reference) return reference.error();
    auto groom = references_.groom(subject.groom);
    if (!groom) return groom.error();
    FrameRun run = frame_run(job, sizes_);
    run.choices = choices;
    auto drawn = draw_frames(device_, **groom, run);
    if (!drawn) return drawn.error();
    return Combination{std::move(choices), spread_of(frame_times(*drawn)).median,
                       relative_l1(mean_of(drawn->pictures), **reference)};
}

}  // namespace vellus::demo
