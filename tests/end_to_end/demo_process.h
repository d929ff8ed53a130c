#pragma once

#include "tests/support/process.h"

namespace vellus::test {

/// vellus_demo with these arguments.
inline std::vector<std::string> demo(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), VELLUS_DEMO);
    return arguments;
}

}  // namespace vellus::test
