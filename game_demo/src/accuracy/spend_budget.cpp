#include "game_demo/src/accuracy/spend_budget.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/platform/log.h"
#include "game_demo/src/accuracy/setting.h"
#include "modules/hair/components.h"
#include "modules/hair/geometry/groom_colors.h"
#include "modules/scene/components.h"

namespace vellus::demo {

namespace {

/// What one groom may choose without touching the others.
bool is_own(const AxisChoice& choice) {
    return choice.setting.empty() || choice.setting.starts_with("detail=");
}

/// The file's name alone.
std::string short_name(const std::string& name) {
    return std::filesystem::path(name.substr(0, name.find(" ("))).stem().string();
}

std::string names(const std::vector<AxisChoice>& choices) {
    std::string result;
    for (const AxisChoice& choice : choices) {
        result.append(result.empty() ? "" : ", ").append(text(choice));
    }
    return result;
}

}  // namespace

Result<AccuracyTable> load_accuracy_or_default(const std::filesystem::path& path) {
    const auto ours = std::filesystem::path(VELLUS_ASSET_DIR) / "accuracy" / "frames.json";
    return load_accuracy(path.empty() ? ours : path);
}

std::optional<FrameShare> FrameWatch::add(const graph::FrameReport& report) {
    if (done()) return std::nullopt;
    shares_.push_back(frame_share(report));
    if (!done()) return std::nullopt;
    std::vector<double> hair;
    std::vector<double> other;
    for (const FrameShare& share : std::span(shares_).subspan(kWarmUp)) {
        hair.push_back(share.hair_ms);
        other.push_back(share.other_ms);
    }
    return FrameShare{spread_of(std::move(hair)).median, spread_of(std::move(other)).median};
}

FrameShare frame_share(const graph::FrameReport& report) {
    FrameShare share;
    for (const graph::PassReport& pass : report.passes) {
        (pass.name.starts_with("hair/") ? share.hair_ms : share.other_ms) += pass.gpu_ms;
    }
    return share;
}

std::vector<KnownGroom> known_grooms(World& world, const AccuracyTable& table) {
    const auto& library = world.resource<hair::HairLibrary>().grooms;
    std::vector<KnownGroom> known;
    world.query<Entity, const hair::Hair, const hair::HairMaterial, const scene::WorldTransform>()
        .each([&](Entity entity, const hair::Hair& hair, const hair::HairMaterial& material,
                  const scene::WorldTransform& placed) {
            const hair::LibraryGroom& groom = library[hair.groom];
            const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(placed.matrix))));
            const GroomClass kind{groom_kind(groom.positions, groom.strand_begin, scale),
                                  colour_kind(hair::mean_color(groom, material))};
            FrameModel model = frame_model(table, kind.groom, kind.colour);
            std::erase_if(model.effects,
                          [](const ChoiceEffect& effect) { return !is_own(effect.choice); });
            known.push_back(
                {entity, short_name(groom.name), kind, groom.positions.size(), std::move(model)});
        });
    // The one that matters most first.
    std::ranges::stable_sort(known, std::greater{}, &KnownGroom::points);
    return known;
}

std::vector<AxisChoice> choices_of(World& world, Entity hair) {
    const auto& techniques = *world.get<hair::HairTechniques>(hair);
    const auto* detail = world.get<hair::HairDetail>(hair);
    std::vector<AxisChoice> choices;
    for (const std::string_view axis : hair::axes()) {
        choices.push_back({std::string(axis), std::string(technique_id(techniques, axis)), ""});
        if (axis == "opacity" && detail != nullptr && detail->share > 0.0f &&
            detail->share < 1.0f) {
            choices.back().setting = fmt::format("detail={:.4g}", detail->share);
        }
    }
    return choices;
}

Result<void> spend_budget(World& world, const AccuracyTable& table, const FrameShare& measured,
                          double budget_ms) {
    const auto grooms = known_grooms(world, table);
    const double left = std::max(budget_ms - measured.other_ms, 0.0);
    const double share = measured.hair_ms > 0.0 ? left / measured.hair_ms : 1.0;
    log_info(
        "budget {:.1f} ms: hair takes {:.1f}, all else {:.1f}; hair gets {:.2f} times its time",
        budget_ms, measured.hair_ms, measured.other_ms, share);
    for (const KnownGroom& groom : grooms) {
        const double now = predict(groom.model, choices_of(world, groom.entity)).ms;
        const auto best = best_within(groom.model, share * now);
        if (!best) {
            return Error{"has no row of a whole frame", "the table of vellus_accuracy",
                         "measure axis frame too"};
        }
        for (const AxisChoice& choice : best->choices) {
            if (auto applied = apply_choice(world, groom.entity, choice); !applied) return applied;
        }
        log_info("{} ({}, {}): {}; predicted {:.2f} of its time, error {:.3f}", groom.name,
                 groom.kind.groom, groom.kind.colour, names(best->choices),
                 now > 0.0 ? best->ms / now : 1.0, best->error);
    }
    return {};
}

}  // namespace vellus::demo
