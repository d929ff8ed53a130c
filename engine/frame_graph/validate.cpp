#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

/// Reports who asks for what the device does not support of the resource's format.
void check_format(const CompileState& s, uint32_t resource, uint32_t supported) {
    for (const AccessRecord& access : s.graph->accesses()) {
        if (access.resource != resource || (info(access.access).image_usage & ~supported) == 0) {
            continue;
        }
        s.report(Problem::kUnsupportedFormat, access.pass, resource, access.where);
    }
}

void check_formats(const CompileState& s) {
    const auto resources = s.graph->resources();
    for (uint32_t i = 0; i < resources.size(); ++i) {
        const ResourceRecord& resource = resources[i];
        if (resource.kind != ResourceKind::kImage) continue;
        const uint32_t supported =
            (*s.options->format_usage)[static_cast<size_t>(resource.image.format)];
        if ((resource.usage & ~supported) != 0) check_format(s, i, supported);
    }
}

}  // namespace

/// Most mistakes were seen while describing. Left are those of a whole pass, and of the device.
bool validate(CompileState& s) {
    const auto passes = s.graph->passes();
    for (uint32_t i = 0; i < passes.size(); ++i) {
        if (passes[i].kind != PassKind::kRaster || passes[i].colors + passes[i].depths != 0) {
            continue;
        }
        s.report(Problem::kUnsupportedUsage, i, kNoIndex, passes[i].where);
    }
    if (s.options->format_usage) check_formats(s);
    return s.diagnostics->empty();
}

}  // namespace vellus::graph
