#include <iostream>

#include "game_demo/tools/groom/program.h"

int main(int argc, char** argv) {
    return vellus::groom_tool::run(argc, argv, std::cout, std::cerr);
}
