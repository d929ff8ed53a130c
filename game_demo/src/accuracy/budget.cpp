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

/// Errors of several rows, for their mean.
struct MeanError {
    double bias = 0.0;
    double rest = 0.0;
    uint32_t count = 0;

    void add(const AccuracyRow& row) {
        const FrameFigures figures = figures_of(row);
        bias += figures.bias;
        rest += figures.rest;
        ++count;
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

bool is_base(const AccuracyRow& row) {
    return row.axis == kFrameAxis && row.technique == kBase;
}

/// Of the groom's base in any colour, for a frame takes as long in all of them; of every groom's
/// where this one was not measured.
double base_time(const AccuracyTable& table, std::string_view groom) {
    std::vector<double> own;
    std::vector<double> all;
    for (const AccuracyRow& row : table.rows) {
        if (!is_base(row)) continue;
        all.push_back(row.frame_ms.median);
        if (row.groom == groom) own.push_back(row.frame_ms.median);
    }
    return spread_of(own.empty() ? std::move(all) : std::move(own)).median;
}

/// Time of the row's frame over that of the base in the same picture; none where that is unknown.
std::optional<double> time_ratio(const AccuracyTable& table, const AccuracyRow& row) {
    const auto base = std::ranges::find_if(table.rows, [&](const AccuracyRow& other) {
        return is_base(other) && other.groom == row.groom && other.colour == row.colour &&
               other.light == row.light && other.device == row.device;
    });
    if (base == table.rows.end() || base->frame_ms.median <= 0.0) return std::nullopt;
    return row.frame_ms.median / base->frame_ms.median;
}

/// Rows of one choice: errors in the pictures asked for, times over the base's in all pictures. A
/// tenth of noise in every row would make the cheapest sum of a few differences too cheap by far.
struct ChoiceRows {
    AxisChoice choice;
    MeanError error;
    std::vector<double> ratios;

    [[nodiscard]] FrameFigures figures(double base_ms) const {
        const double ratio = ratios.empty() ? 1.0 : spread_of(ratios).median;
        return {base_ms * ratio, error.bias / error.count, error.rest / error.count};
    }
};

std::vector<ChoiceRows> rows_by_choice(const AccuracyTable& table, std::string_view groom,
                                       std::string_view colour) {
    std::vector<ChoiceRows> choices;
    for (const AccuracyRow* row : matching(table, groom, colour)) {
        const AxisChoice choice = choice_of(*row);
        auto found = std::ranges::find(choices, choice, &ChoiceRows::choice);
        if (found == choices.end()) found = choices.insert(choices.end(), {choice, {}, {}});
        found->error.add(*row);
    }
    for (const AccuracyRow& row : table.rows) {
        if (row.axis != kFrameAxis || is_base(row)) continue;
        const auto found = std::ranges::find(choices, choice_of(row), &ChoiceRows::choice);
        if (found == choices.end()) continue;
        if (const auto ratio = time_ratio(table, row)) found->ratios.push_back(*ratio);
    }
    return choices;
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
    const std::vector<ChoiceRows> choices = rows_by_choice(table, groom, colour);
    const auto is_the_base = [](const ChoiceRows& each) { return each.choice.axis.empty(); };
    const auto base = std::ranges::find_if(choices, is_the_base);
    if (base == choices.end()) return {};
    FrameModel model{base->figures(base_time(table, groom)), base_choices(), {}};
    for (const ChoiceRows& each : choices) {
        if (is_the_base(each)) continue;
        const FrameFigures changed = each.figures(model.base.ms);
        model.effects.push_back({each.choice,
                                 {changed.ms - model.base.ms, changed.bias - model.base.bias,
                                  changed.rest - model.base.rest}});
    }
    return model;
}

Combination predict(const FrameModel& model, std::vector<AxisChoice> choices) {
    Combination result{std::move(choices)};
    FrameFigures sum = model.base;
    double least = model.base.rest;
    double brighter = 0.0;
    double darker = 0.0;
    for (const AxisChoice& choice : result.choices) {
        const auto found = std::ranges::find(model.effects, choice, &ChoiceEffect::choice);
        if (found == model.effects.end()) continue;
        sum.ms += found->change.ms;
        sum.bias += found->change.bias;
        sum.rest += found->change.rest;
        brighter += std::max(found->change.bias, 0.0);
        darker += std::max(-found->change.bias, 0.0);
        least = std::min(least, model.base.rest + found->change.rest);
    }
    // Two choices that each mend the same fault mend it once.
    sum.rest = std::max(sum.rest, least);
    // What one choice makes too bright and another too dark makes up for each other as a whole, but
    // not pixel by pixel.
    const double cancelled = std::min(brighter, darker);
    sum.rest += cancelled * cancelled;
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
