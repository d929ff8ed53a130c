#include <iostream>

#include "game_demo/tools/reference/reference.h"

int main(int argc, char** argv) {
    const auto parsed = vellus::demo::parse_reference_options(argc, argv, std::cout, std::cerr);
    return parsed.exit_status ? *parsed.exit_status : vellus::demo::run_reference(parsed.options);
}
