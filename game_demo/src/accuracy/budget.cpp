#include "game_demo/src/accuracy/budget.h"

#include <algorithm>
#include <map>

#include "modules/hair/techniques.h"

namespace vellus::demo {

namespace {

/// Sums for a mean.
struct Mean {
    double ms = 0.0;
    double error = 0.0;
    uint32_t count = 0;

    void add(const AccuracyRow& row) {
        ms += row.frame_ms.median;
        error += row.error;
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

std::vector<AxisChoice> default_choices() {
    std::vector<AxisChoice> choices;
    for (const std::string_view axis : hair::axes()) {
        choices.push_back(
            {std::string(axis), std::string(hair::technique_id(hair::HairTechniques{}, axis)), ""});
    }
    return choices;
}

}  // namespace

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
    FrameModel model{base.ms / base.count, base.error / base.count, default_choices(), {}};
    for (const auto& [choice, sum] : sums) {
        model.effects.push_back(
            {choice, sum.ms / sum.count - model.ms, sum.error / sum.count - model.error});
    }
    return model;
}

Combination predict(const FrameModel& model, std::vector<AxisChoice> choices) {
    Combination result{std::move(choices), model.ms, model.error};
    for (const AxisChoice& choice : result.choices) {
        const auto found = std::ranges::find(model.effects, choice, &ChoiceEffect::choice);
        if (found == model.effects.end()) continue;
        result.ms += found->ms;
        result.error += found->error;
    }
    result.ms = std::max(result.ms, 0.0);
    result.error = std::max(result.error, 0.0);
    return result;
}

std::vector<Combination> combinations(const FrameModel& model) {
    std::vector<std::vector<AxisChoice>> all = {{}};
    for (const AxisChoice& usual : model.defaults) {
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
