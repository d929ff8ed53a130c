#pragma once

#include "game_demo/src/accuracy/spend_budget.h"
#include "game_demo/src/demo_state.h"

namespace vellus::demo {

/// Error against time of everything the table knows for grooms like those of the scene, with the
/// Pareto front of all combinations and the point where a groom is now; a click on a point chooses
/// it.
class AccuracyPanel {
  public:
    AccuracyPanel() = default;
    explicit AccuracyPanel(AccuracyTable table) : table_(std::move(table)) {}

    [[nodiscard]] const AccuracyTable& table() const { return table_; }
    /// `budget_ms` 0: none.
    void show(DemoState& state, World& world, const graph::FrameReport& report, double budget_ms);
    /// Another scene: its grooms are looked at anew.
    void forget() { grooms_.clear(); }

  private:
    struct Curve {
        KnownGroom groom;
        std::vector<Combination> front;
    };
    void chart(const Curve& curve, World& world, double hair_ms, double hair_budget_ms);

    AccuracyTable table_;
    std::vector<Curve> grooms_;
    size_t shown_ = 0;
};

}  // namespace vellus::demo
