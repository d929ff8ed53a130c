#include <iostream>

#include "game_demo/src/app.h"

int main(int argc, char** argv) {
    const auto parsed = vellus::demo::parse_options(argc, argv, std::cout, std::cerr);
    return parsed.exit_status ? *parsed.exit_status : vellus::demo::run(parsed.options);
}
