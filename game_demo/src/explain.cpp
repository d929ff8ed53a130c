#include "game_demo/src/explain.h"

#include <fmt/format.h>

#include <cstdio>

namespace vellus::demo {

void print_explanation(const Renderer& renderer) {
    fmt::print("effects:\n");
    for (const EffectRow& row : renderer.effects()) {
        fmt::print("  {}: {}={}: {}\n", row.groom, row.axis, row.technique, row.reason);
    }
    fmt::print("frame graph:\n{}\n", renderer.explain_graph());
    std::fflush(stdout);
}

}  // namespace vellus::demo
