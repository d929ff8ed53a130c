#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "engine/frame_graph/description.h"
#include "engine/frame_graph/diagnostics.h"
#include "engine/frame_graph/plan.h"

namespace vellus::graph {

/// What the driver says a resource needs (vkGetDevice*MemoryRequirements).
struct MemoryNeeds {
    uint64_t bytes = 0;
    uint64_t alignment = 1;  ///< a power of two
    uint32_t type_bits = 1;
};

/// Must give the same answer for the same question. `usage` is that of Placement.
using MemoryNeedsFunction = MemoryNeeds (*)(const void* user, const ResourceRecord& resource,
                                            uint32_t usage);

/// Tightly packed, aligned to 256 bytes: for use without a device.
MemoryNeeds packed_memory_needs(const void* user, const ResourceRecord& resource, uint32_t usage);

/// Debugging aids; the picture is the same with each of them.
struct Switches {
    bool no_culling = false;
    bool no_aliasing = false;
    bool full_barriers = false;
    bool poison = false;        ///< fill memory with a pattern whenever a resource takes it over
    bool immediate = false;     ///< full barriers, and the executor submits after every pass
    bool random_order = false;  ///< any legal order, by `seed`
    uint64_t seed = 0;
};

constexpr size_t kFormatCount = static_cast<size_t>(gpu::Format::kD32Float) + 1;

struct CompileOptions {
    Switches switches;
    MemoryNeedsFunction memory_needs = packed_memory_needs;
    const void* memory_user = nullptr;
    /// VkImageUsageFlags the device supports per format; empty rows (all zero table): everything.
    const std::array<uint32_t, kFormatCount>* format_usage = nullptr;
};

struct CompileState;

/// Description in, plan or diagnostics out: the result depends on the arguments alone. The object
/// only keeps scratch memory, so that compiling a steady frame allocates nothing.
class Compiler {
  public:
    Compiler();
    ~Compiler();
    Compiler(Compiler&&) noexcept;
    Compiler& operator=(Compiler&&) noexcept;

    /// True: `plan` is complete. False: `diagnostics` says why; `plan` is unspecified.
    [[nodiscard]] bool compile(const GraphDescription& graph, const CompileOptions& options,
                               Plan& plan, Diagnostics& diagnostics);

  private:
    std::unique_ptr<CompileState> state_;
};

}  // namespace vellus::graph
