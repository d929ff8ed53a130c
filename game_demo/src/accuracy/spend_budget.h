#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/ecs/ecs.h"
#include "engine/frame_graph/execute.h"
#include "game_demo/src/accuracy/budget.h"
#include "game_demo/src/accuracy/groom_class.h"

namespace vellus::demo {

/// The table of this file; of the one that came with the program where the path is empty.
Result<AccuracyTable> load_accuracy_or_default(const std::filesystem::path& path);

/// Device times of a frame: of hair, and of everything else, milliseconds.
struct FrameShare {
    double hair_ms = 0.0;
    double other_ms = 0.0;
};
FrameShare frame_share(const graph::FrameReport& report);

/// Looks at frames until it knows what one takes: the median of a few, after a few to warm up.
class FrameWatch {
  public:
    /// The share of hair, once, after the last frame it wants.
    std::optional<FrameShare> add(const graph::FrameReport& report);
    [[nodiscard]] bool done() const { return shares_.size() == kFrames; }

  private:
    static constexpr size_t kWarmUp = 4;
    static constexpr size_t kFrames = 12;

    std::vector<FrameShare> shares_;
};

/// A hair entity and what the table knows of hair like it.
struct KnownGroom {
    Entity entity;
    std::string name;
    GroomClass kind;
    size_t points = 0;
    FrameModel model;  ///< only what is a groom's own choice: techniques, and `detail`
};
std::vector<KnownGroom> known_grooms(World& world, const AccuracyTable& table);

/// The choices a groom is drawn with.
std::vector<AxisChoice> choices_of(World& world, Entity hair);

/// Picks for every groom what errs least within the same share of its time, so that the hair drawn
/// so far, `measured`, becomes hair that leaves the frame within `budget_ms`; logs each choice. An
/// Error where the table has no whole frames.
Result<void> spend_budget(World& world, const AccuracyTable& table, const FrameShare& measured,
                          double budget_ms);

}  // namespace vellus::demo
