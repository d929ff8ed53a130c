#pragma once

#include "game_demo/src/accuracy/table.h"

namespace vellus::demo {

/// A line per row, a header first.
std::string to_csv(const AccuracyTable& table);
/// One page that needs nothing else, with the pictures found below `folder` in it; rows without
/// pictures stay.
std::string to_html(const AccuracyTable& table, const std::filesystem::path& folder);
/// `text` as it may stand between tags or in quotes.
std::string escape_html(std::string_view text);
/// JSON that nothing in it can end the script element it stands in.
std::string escape_script(std::string json);

/// The rows of kFrameAxis without pictures: all that the demo needs.
AccuracyTable frames_alone(const AccuracyTable& table);

/// FOLDER/accuracy.csv, accuracy.json, frames.json (of frames_alone()) and accuracy.html.
Result<void> write_reports(const std::filesystem::path& folder, const AccuracyTable& table);

}  // namespace vellus::demo
