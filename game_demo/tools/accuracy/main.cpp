#include <iostream>

#include "game_demo/tools/accuracy/run.h"

int main(int argc, char** argv) {
    const auto parsed = vellus::demo::parse_accuracy_options(argc, argv, std::cout, std::cerr);
    return parsed.exit_status ? *parsed.exit_status : vellus::demo::run_accuracy(parsed.options);
}
