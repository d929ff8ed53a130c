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

/// What frames are measured around: best_techniques(), because effects add up best where they are
/// small.
std::vector<AxisChoice> base_choices();

/// Time and error of a frame, the error in two parts that add up over choices: how much too bright
/// the hair is as a whole (light of different origin is a sum), and the square of what is left of
/// the error without that.
struct FrameFigures {
    double ms = 0.0;
    double bias = 0.0;
    double rest = 0.0;

    /// √(bias² + rest): relative L1.
    [[nodiscard]] double error() const;
};

/// What a choice changes about the base. The effects of several add up.
struct ChoiceEffect {
    AxisChoice choice;
    FrameFigures change;
};

/// A frame as measured: the base, and what each choice on each axis does to it.
struct FrameModel {
    FrameFigures base;
    std::vector<AxisChoice> choices;  ///< of the base, by axis
    std::vector<ChoiceEffect> effects;

    [[nodiscard]] bool empty() const { return base.ms <= 0.0; }
};

/// Errors are means of the rows of kFrameAxis with this groom and colour; where there are none, of
/// those with this groom, else of all. The base's time is the median over the groom's colours, what
/// a choice does to it the median share over all pictures. Empty where nothing was measured.
FrameModel frame_model(const AccuracyTable& table, std::string_view groom, std::string_view colour);

/// One choice an axis, and what the model says of them together.
struct Combination {
    std::vector<AxisChoice> choices;
    double ms = 0.0;
    double error = 0.0;
};
/// Time and error of these choices; what the model does not know counts as the base.
Combination predict(const FrameModel& model, std::vector<AxisChoice> choices);
/// Every combination of choices the model knows.
std::vector<Combination> combinations(const FrameModel& model);

/// The one with the least error that takes at most `budget_ms`, the cheaper of equally good ones;
/// none fits: the cheapest of all. Nothing for an empty model.
std::optional<Combination> best_within(const FrameModel& model, double budget_ms);

}  // namespace vellus::demo
