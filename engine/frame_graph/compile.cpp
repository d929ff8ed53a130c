#include "engine/frame_graph/compile.h"

#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

Compiler::Compiler() : state_(std::make_unique<CompileState>()) {}
Compiler::~Compiler() = default;
Compiler::Compiler(Compiler&&) noexcept = default;
Compiler& Compiler::operator=(Compiler&&) noexcept = default;

bool Compiler::compile(const GraphDescription& graph, const CompileOptions& options, Plan& plan,
                       Diagnostics& diagnostics) {
    CompileState& s = *state_;
    s.graph = &graph;
    s.options = &options;
    s.plan = &plan;
    s.diagnostics = &diagnostics;
    s.full_barriers = options.switches.full_barriers || options.switches.immediate;
    diagnostics.assign(graph.problems().begin(), graph.problems().end());
    if (!validate(s) || !cull(s) || !order_passes(s)) return false;
    find_lifetimes(s);
    return schedule(s);
}

MemoryNeeds packed_memory_needs(const void* /*user*/, const ResourceRecord& resource,
                                uint32_t /*usage*/) {
    if (resource.kind == ResourceKind::kBuffer) return {resource.buffer.bytes, 256, 1};
    const ImageDesc& image = resource.image;
    uint64_t pixels = uint64_t{image.width} * image.height;
    for (uint32_t mip = 1; mip < image.mips; ++mip) {
        const uint64_t width = image.width >> mip, height = image.height >> mip;
        pixels += (width ? width : 1) * (height ? height : 1);
    }
    return {pixels * image.layers * gpu::bytes_per_pixel(image.format), 256, 1};
}

}  // namespace vellus::graph
