#pragma once

#include <iosfwd>

namespace vellus::groom_tool {

/// The program vellus_groom; its exit status: 0, 1 for a failure, 2 for a mistake on the command
/// line. Either is one line on `err` that names file or option, what is wrong, and the remedy.
int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace vellus::groom_tool
