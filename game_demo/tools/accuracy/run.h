#pragma once

#include "game_demo/tools/accuracy/accuracy_options.h"

namespace vellus::demo {

/// What the program does with its options. Its exit status: 0, 1 with one line on stderr, or 130
/// after Ctrl-C, with all that was done until then.
int run_accuracy(const AccuracyOptions& options);

}  // namespace vellus::demo
