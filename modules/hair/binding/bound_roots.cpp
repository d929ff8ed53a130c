#include "modules/hair/binding/bound_roots.h"

namespace vellus::hair {

Result<BoundRootBuffers> BoundRootBuffers::upload(gpu::Device& device, const BoundRoots& bound) {
    BoundRootBuffers buffers;
    const auto column = [&](auto values, const char* name, gpu::Buffer& out) -> Result<void> {
        auto made = gpu::Buffer::upload_span(device, values, name);
        if (!made) return made.error();
        out = *std::move(made);
        return {};
    };
    const Result<void> steps[] = {
        column(std::span(bound.vertices), "hair bound vertices", buffers.vertices),
        column(std::span(bound.morphs), "hair bound morph targets", buffers.morphs),
        column(std::span(bound.roots), "hair roots", buffers.roots),
        column(std::span(bound.local), "hair points in root frames", buffers.local),
    };
    for (const auto& step : steps) {
        if (!step) return step.error();
    }
    return buffers;
}

uint64_t BoundRootBuffers::bytes() const {
    return vertices.bytes() + morphs.bytes() + roots.bytes() + local.bytes();
}

}  // namespace vellus::hair
