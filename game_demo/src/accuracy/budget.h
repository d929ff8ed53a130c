#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "game_demo/src/accuracy/table.h"

namespace vellus::demo {

/// A technique on an axis, at a setting (empty: as the demo has it).
struct AxisChoice {
    std::string axis;
    std::string technique;
    std::string setting;

    bool operator==(const AxisChoice&) const = default;
};
/// "shadow=none", "opacity=dither detail=0.5".
std::string text(const AxisChoice& choice);

/// What a choice changes about the frame of defaults. The effects of several add up.
struct ChoiceEffect {
    AxisChoice choice;
    double ms = 0.0;
    double error = 0.0;
};

/// A frame as measured: that of defaults, and what each choice on each axis does to it.
struct FrameModel {
    double ms = 0.0;
    double error = 0.0;
    std::vector<AxisChoice> defaults;  ///< by axis
    std::vector<ChoiceEffect> effects;

    [[nodiscard]] bool empty() const { return ms <= 0.0; }
};

/// From the rows of kFrameAxis with this groom and colour; where there are none, from those with
/// this groom, else from all: means over what was measured. Empty where nothing was.
FrameModel frame_model(const AccuracyTable& table, std::string_view groom, std::string_view colour);

/// One choice an axis, and what the model says of them together.
struct Combination {
    std::vector<AxisChoice> choices;
    double ms = 0.0;
    double error = 0.0;
};
/// Time and error of these choices; what the model does not know counts as a default.
Combination predict(const FrameModel& model, std::vector<AxisChoice> choices);
/// Every combination of choices the model knows.
std::vector<Combination> combinations(const FrameModel& model);

/// The one with the least error that takes at most `budget_ms`, the cheaper of equally good ones;
/// none fits: the cheapest of all. Nothing for an empty model.
std::optional<Combination> best_within(const FrameModel& model, double budget_ms);

}  // namespace vellus::demo
