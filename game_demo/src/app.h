#pragma once

#include "game_demo/src/options.h"

namespace vellus::demo {

/// Does what the options ask for; the program's exit status: 0, or 1 with one line on stderr.
int run(const Options& options);

}  // namespace vellus::demo
