#pragma once

#include "game_demo/src/accuracy/table.h"
#include "game_demo/tools/accuracy/accuracy_options.h"

namespace vellus::demo {

/// By axis, technique, setting, groom, colour, light; of rows with one id and device the first.
void sort_rows(AccuracyTable& table);
/// All rows of the tables, under the first one's description; devices are named together.
AccuracyTable join(std::vector<AccuracyTable> tables);

/// The results of all folders of --merge into --out: rows, pictures and reports.
Result<void> merge(const AccuracyOptions& options);

}  // namespace vellus::demo
