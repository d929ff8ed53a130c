#pragma once

#include <cstdint>
#include <span>

#include "engine/frame_graph/compile.h"

namespace vellus::graph::test {

/// Choices from a fuzzer's bytes, then from a generator seeded by them.
class Choices {
  public:
    explicit Choices(std::span<const uint8_t> bytes, uint64_t seed = 0)
        : bytes_(bytes), state_(seed) {}
    /// 0 to count - 1.
    uint32_t below(uint32_t count);
    bool one_in(uint32_t count) { return below(count) == 0; }

  private:
    std::span<const uint8_t> bytes_;
    uint64_t state_;
};

/// Describes some frame; nearly always a legal one unless `mischief`.
void random_graph(Choices& choices, bool mischief, GraphDescription& graph);
Switches random_switches(Choices& choices);

}  // namespace vellus::graph::test
