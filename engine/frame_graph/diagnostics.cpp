#include "engine/frame_graph/diagnostics.h"

#include <fmt/format.h>

#include <filesystem>

#include "engine/frame_graph/description.h"

namespace vellus::graph {

namespace {

std::string resource_name(const GraphDescription& graph, uint32_t resource) {
    if (resource >= graph.resources().size()) return "a resource";
    return fmt::format("'{}'", graph.resources()[resource].name);
}

std::string sentence(const GraphDescription& graph, const Diagnostic& d) {
    const std::string name = resource_name(graph, d.resource);
    const std::string other = d.other_pass < graph.passes().size()
                                  ? fmt::format("pass '{}'", graph.passes()[d.other_pass].name)
                                  : "another pass";
    switch (d.problem) {
        case Problem::kReadNeverWritten:
            return fmt::format("reads {}, which no pass has written (write or clear it first)",
                               name);
        case Problem::kStaleHandle:
            return "uses a handle that is not of this description (declare it again each frame)";
        case Problem::kTwoWriters:
            return fmt::format(
                "writes a version of {} that {} writes already (write the version it returned)",
                name, other);
        case Problem::kConflictingAccess:
            return fmt::format(
                "accesses {} twice in ways that exclude each other (declare one read-write access, "
                "or ranges that do not overlap)",
                name);
        case Problem::kUndeclaredAccess:
            return fmt::format("records an access to {} that it did not declare (declare it)",
                               name);
        case Problem::kMissingHistory:
            return fmt::format(
                "reads the history {}, but no pass writes its next image (write `next`)", name);
        case Problem::kCycle:
            return fmt::format(
                "must run both before and after {} because of {} (read the newer version)", other,
                name);
        case Problem::kUnsupportedFormat:
            return fmt::format("the size or format of {} does not allow this", name);
        case Problem::kUnsupportedUsage:
            return fmt::format("this kind of access to {} is not possible here", name);
        case Problem::kOutputOverwritten:
            return fmt::format(
                "asks for a version of {} that {} overwrites (ask for the last version)", name,
                other);
    }
    return {};
}

}  // namespace

std::string describe(const GraphDescription& graph, const Diagnostic& diagnostic) {
    const std::string file = std::filesystem::path(diagnostic.where.file).filename().string();
    const std::string pass = diagnostic.pass < graph.passes().size()
                                 ? fmt::format("pass '{}'", graph.passes()[diagnostic.pass].name)
                                 : "the graph";
    return fmt::format("{}:{}: {}: {}", file, diagnostic.where.line, pass,
                       sentence(graph, diagnostic));
}

std::string describe(const GraphDescription& graph, std::span<const Diagnostic> diagnostics) {
    std::string lines;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (!lines.empty()) lines += '\n';
        lines += describe(graph, diagnostic);
    }
    return lines;
}

}  // namespace vellus::graph
