#include "game_demo/src/panels/accuracy_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "engine/platform/log.h"
#include "game_demo/src/accuracy/pareto.h"
#include "game_demo/src/accuracy/setting.h"

namespace vellus::demo {

namespace {

constexpr ImU32 kGrid = IM_COL32(255, 255, 255, 28);
constexpr ImU32 kSoft = IM_COL32(255, 255, 255, 120);
constexpr ImU32 kFront = IM_COL32(240, 153, 90, 255);
constexpr ImU32 kOther = IM_COL32(139, 155, 171, 200);
constexpr ImU32 kNow = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kBudget = IM_COL32(120, 200, 140, 160);

std::vector<Combination> front_of(const FrameModel& model) {
    const auto all = combinations(model);
    std::vector<CostAndError> points;
    points.reserve(all.size());
    for (const Combination& each : all) points.push_back({each.ms, each.error});
    std::vector<Combination> front;
    for (const size_t i : pareto_front(points)) front.push_back(all[i]);
    return front;
}

/// Choices that are not the base's, or "base".
std::string short_name(const Combination& combination, const FrameModel& model) {
    std::string name;
    for (const AxisChoice& choice : combination.choices) {
        if (std::ranges::find(model.choices, choice) != model.choices.end()) continue;
        name.append(name.empty() ? "" : ", ").append(text(choice));
    }
    return name.empty() ? kBase : name;
}

/// Milliseconds and error to the window's pixels.
struct Plot {
    ImVec2 low{0, 0};
    ImVec2 high{0, 0};
    double most_ms = 1.0;
    double most_error = 1.0;

    [[nodiscard]] ImVec2 at(double ms, double error) const {
        const auto x = static_cast<float>(ms / most_ms);
        const auto y = static_cast<float>(error / most_error);
        return {low.x + x * (high.x - low.x),
                high.y - std::clamp(y, 0.0f, 1.0f) * (high.y - low.y)};
    }
};

double step_for(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(most, 1e-6) / 4.0)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power * 5.0 >= most) return factor * power;
    }
    return 10.0 * power;
}

void draw_grid(ImDrawList& list, const Plot& plot) {
    const auto label = [&](ImVec2 at, const std::string& words) {
        list.AddText(at, kSoft, words.data(), words.data() + words.size());
    };
    const double ms_step = step_for(plot.most_ms);
    for (int i = 0; i * ms_step <= plot.most_ms; ++i) {
        const double ms = i * ms_step;
        const float x = plot.at(ms, 0.0).x;
        list.AddLine({x, plot.low.y}, {x, plot.high.y}, kGrid);
        if (x + 44.0f > plot.high.x) continue;
        label({x + 2.0f, plot.high.y + 2.0f}, fmt::format("{:.3g} ms", ms));
    }
    const double error_step = step_for(plot.most_error);
    for (int i = 0; i * error_step <= plot.most_error; ++i) {
        const double error = i * error_step;
        const float y = plot.at(0.0, error).y;
        list.AddLine({plot.low.x, y}, {plot.high.x, y}, kGrid);
        label({plot.low.x + 2.0f, y - 14.0f}, fmt::format("{:.0f} %", 100.0 * error));
    }
}

void apply(World& world, Entity hair, const Combination& combination) {
    for (const AxisChoice& choice : combination.choices) {
        if (auto done = apply_choice(world, hair, choice); !done) {
            log_error("{}", done.error().message());
        }
    }
}

/// A point; its name where the pointer is. True where it was clicked.
bool point(ImDrawList& list, ImVec2 at, float radius, ImU32 colour, const std::string& name) {
    constexpr float kReach = 7.0f;
    list.AddCircleFilled(at, radius, colour);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (std::hypot(mouse.x - at.x, mouse.y - at.y) > kReach || !ImGui::IsWindowHovered()) {
        return false;
    }
    list.AddCircle(at, kReach, kNow);
    ImGui::SetTooltip("%s", name.c_str());
    return ImGui::IsMouseClicked(0);
}

}  // namespace

void AccuracyPanel::chart(const Curve& curve, World& world, double hair_ms, double hair_budget_ms) {
    const FrameModel& model = curve.groom.model;
    const Combination now = predict(model, choices_of(world, curve.groom.entity));
    // The table's milliseconds are those of another picture: as many times longer as now's are.
    const double scale = now.ms > 0.0 ? hair_ms / now.ms : 1.0;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float height = std::max(room.y - 78.0f, 120.0f);
    Plot plot{.low = {origin.x, origin.y + 4.0f}, .high = {origin.x + room.x, origin.y + height}};
    plot.most_ms = scale * now.ms;
    plot.most_error = now.error;
    for (const ChoiceEffect& effect : model.effects) {
        const Combination one = predict(model, {effect.choice});
        plot.most_ms = std::max(plot.most_ms, scale * one.ms);
        plot.most_error = std::max(plot.most_error, one.error);
    }
    plot.most_ms *= 1.1;
    plot.most_error *= 1.15;
    draw_grid(list, plot);
    if (hair_budget_ms > 0.0) {
        const float x = plot.at(std::min(hair_budget_ms, plot.most_ms), 0.0).x;
        list.AddLine({x, plot.low.y}, {x, plot.high.y}, kBudget, 2.0f);
    }
    const auto say = [&](const Combination& each) {
        return fmt::format("{}\n{:.1f} ms, error {:.1f} %", short_name(each, model),
                           scale * each.ms, 100.0 * each.error);
    };
    for (const ChoiceEffect& effect : model.effects) {
        const Combination one = predict(model, {effect.choice});
        if (point(list, plot.at(scale * one.ms, one.error), 3.0f, kOther, say(one))) {
            apply(world, curve.groom.entity, one);
        }
    }
    for (size_t i = 0; i < curve.front.size(); ++i) {
        const Combination& each = curve.front[i];
        const ImVec2 at = plot.at(scale * each.ms, each.error);
        if (i > 0) {
            const ImVec2 before = plot.at(scale * curve.front[i - 1].ms, curve.front[i - 1].error);
            list.AddLine(before, {at.x, before.y}, kFront);
            list.AddLine({at.x, before.y}, at, kFront);
        }
        if (point(list, at, 4.0f, kFront, say(each))) apply(world, curve.groom.entity, each);
    }
    const ImVec2 here = plot.at(scale * now.ms, now.error);
    list.AddCircle(here, 8.0f, kNow, 0, 2.0f);
    list.AddLine({here.x - 12.0f, here.y}, {here.x + 12.0f, here.y}, kNow);
    list.AddLine({here.x, here.y - 12.0f}, {here.x, here.y + 12.0f}, kNow);
    ImGui::Dummy({room.x, height + 20.0f});
    ImGui::TextWrapped("now: %s", say(now).c_str());
}

void AccuracyPanel::show(DemoState& state, World& world, const graph::FrameReport& report,
                         double budget_ms) {
    if (grooms_.empty()) {
        shown_ = 0;
        for (KnownGroom& groom : known_grooms(world, table_)) {
            auto front = front_of(groom.model);
            grooms_.push_back({std::move(groom), std::move(front)});
        }
    }
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = std::min(440.0f, size.x - 16.0f);
    ImGui::SetNextWindowPos({size.x - width - 8.0f, 8.0f}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({width, std::min(400.0f, size.y - 16.0f)}, ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Accuracy against time", &state.accuracy) && !grooms_.empty()) {
        if (grooms_.size() > 1 && ImGui::BeginCombo("groom", grooms_[shown_].groom.name.c_str())) {
            for (size_t i = 0; i < grooms_.size(); ++i) {
                const std::string label = fmt::format("{}##{}", grooms_[i].groom.name, i);
                if (ImGui::Selectable(label.c_str(), i == shown_)) shown_ = i;
            }
            ImGui::EndCombo();
        }
        const Curve& curve = grooms_[shown_];
        const FrameShare measured = frame_share(report);
        if (curve.groom.model.empty()) {
            ImGui::TextWrapped("No table of measurements: start with --accuracy FILE.json");
        } else {
            ImGui::Text("as %s, %s hair; hair now takes %.1f ms",
                        std::string(curve.groom.kind.groom).c_str(),
                        std::string(curve.groom.kind.colour).c_str(), measured.hair_ms);
            chart(curve, world, measured.hair_ms,
                  budget_ms > 0.0 ? budget_ms - measured.other_ms : 0.0);
        }
    }
    ImGui::End();
}

}  // namespace vellus::demo
