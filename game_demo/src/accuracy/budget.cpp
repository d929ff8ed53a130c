#include "game_demo/src/accuracy/budget.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "modules/hair/techniques.h"

namespace vellus::demo {

namespace {

/// Of no picture: darker than black.
constexpr double kAllDark = -1.0;

FrameFigures figures_of(const AccuracyRow& row) {
    const auto bias = row.measures.find("bias");
    FrameFigures figures{.ms = row.frame_ms.median};
    if (bias != row.measures.end()) figures.bias = bias->second;
    figures.rest = std::max(row.error * row.error - figures.bias * figures.bias, 0.0);
    return figures;
}

/// Figures of several rows, for their mean.
struct Mean {
    FrameFigures sum;
    uint32_t count = 0;

    void add(const AccuracyRow& row) {
        const FrameFigures figures = figures_of(row);
        sum.ms += figures.ms;
        sum.bias += figures.bias;
        sum.rest += figures.rest;
        ++count;
    }
    [[nodiscard]] FrameFigures mean() const {
        return {sum.ms / count, sum.bias / count, sum.rest / count};
    }
};

/// "AXIS=TECHNIQUE" of a row of kFrameAxis.
AxisChoice choice_of(const AccuracyRow& row) {
    const size_t equals = row.technique.find('=');
    if (equals == std::string::npos) return {"", row.technique, row.setting};
    return {row.technique.substr(0, equals), row.technique.substr(equals + 1), row.setting};
}

/// Rows of the frame axis that fit best: groom and colour, groom alone, any.
std::vector<const AccuracyRow*> matching(const AccuracyTable& table, std::string_view groom,
                                         std::string_view colour) {
    std::vector<const AccuracyRow*> rows;
    for (const int wanted : {2, 1, 0}) {
        for (const AccuracyRow& row : table.rows) {
            if (row.axis != kFrameAxis) continue;
            if (wanted >= 1 && row.groom != groom) continue;
            if (wanted == 2 && row.colour != colour) continue;
            rows.push_back(&row);
        }
        if (!rows.empty()) break;
    }
    return rows;
}

}  // namespace

std::vector<AxisChoice> base_choices() {
    const hair::HairTechniques techniques = hair::best_techniques();
    std::vector<AxisChoice> choices;
    for (const std::string_view axis : hair::axes()) {
        choices.push_back({std::string(axis), std::string(technique_id(techniques, axis)), ""});
    }
    return choices;
}

double FrameFigures::error() const {
    return std::sqrt(bias * bias + std::max(rest, 0.0));
}

std::string text(const AxisChoice& choice) {
    std::string result = choice.axis + "=" + choice.technique;
    if (!choice.setting.empty()) result.append(" ").append(choice.setting);
    return result;
}

FrameModel frame_model(const AccuracyTable& table, std::string_view groom,
                       std::string_view colour) {
    Mean base;
    std::vector<std::pair<AxisChoice, Mean>> sums;
    for (const AccuracyRow* row : matching(table, groom, colour)) {
        const AxisChoice choice = choice_of(*row);
        if (choice.axis.empty()) {
            base.add(*row);
            continue;
        }
        auto found = std::ranges::find(sums, choice, &std::pair<AxisChoice, Mean>::first);
        if (found == sums.end()) found = sums.insert(sums.end(), {choice, {}});
        found->second.add(*row);
    }
    if (base.count == 0) return {};
    FrameModel model{base.mean(), base_choices(), {}};
    for (const auto& [choice, sum] : sums) {
        const FrameFigures changed = sum.mean();
        model.effects.push_back({choice,
                                 {changed.ms - model.base.ms, changed.bias - model.base.bias,
                                  changed.rest - model.base.rest}});
    }
    return model;
}

Combination predict(const FrameModel& model, std::vector<AxisChoice> choices) {
    Combination result{std::move(choices)};
    FrameFigures sum = model.base;
    double least = model.base.rest;
    for (const AxisChoice& choice : result.choices) {
        const auto found = std::ranges::find(model.effects, choice, &ChoiceEffect::choice);
        if (found == model.effects.end()) continue;
        sum.ms += found->change.ms;
        sum.bias += found->change.bias;
        sum.rest += found->change.rest;
        least = std::min(least, model.base.rest + found->change.rest);
    }
    // Two choices that each mend the same fault mend it once.
    sum.rest = std::max(sum.rest, least);
    sum.bias = std::max(sum.bias, kAllDark);
    result.ms = std::max(sum.ms, 0.0);
    result.error = sum.error();
    return result;
}

std::vector<Combination> combinations(const FrameModel& model) {
    std::vector<std::vector<AxisChoice>> all = {{}};
    for (const AxisChoice& usual : model.choices) {
        std::vector<AxisChoice> here = {usual};
        for (const ChoiceEffect& effect : model.effects) {
            if (effect.choice.axis == usual.axis) here.push_back(effect.choice);
        }
        std::vector<std::vector<AxisChoice>> longer;
        for (const auto& start : all) {
            for (const AxisChoice& choice : here) {
                longer.push_back(start);
                longer.back().push_back(choice);
            }
        }
        all = std::move(longer);
    }
    std::vector<Combination> result;
    result.reserve(all.size());
    for (auto& choices : all) result.push_back(predict(model, std::move(choices)));
    return result;
}

std::optional<Combination> best_within(const FrameModel& model, double budget_ms) {
    if (model.empty()) return std::nullopt;
    std::optional<Combination> best;
    std::optional<Combination> cheapest;
    for (Combination& each : combinations(model)) {
        if (!cheapest || each.ms < cheapest->ms) cheapest = each;
        if (each.ms > budget_ms) continue;
        const bool better =
            !best || each.error < best->error || (each.error == best->error && each.ms < best->ms);
        if (better) best = std::move(each);
    }
    return best ? best : cheapest;
}

}  // namespace vellus::demo
