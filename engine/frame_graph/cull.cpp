#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

void want(CompileState& s, uint32_t version) {
    s.needed[version] = 1;
    const uint32_t writer = s.graph->versions()[version].writer;
    if (writer == kNoIndex || s.plan->alive[writer]) return;
    s.plan->alive[writer] = 1;
    s.stack.push_back(writer);
}

/// Who reads last frame's image needs this frame's to be written.
void want_history(CompileState& s, const AccessRecord& access, const ResourceRecord& previous) {
    const ResourceRecord& next = s.graph->resources()[previous.partner];
    if (next.last_version == next.first_version) {
        s.report(Problem::kMissingHistory, access.pass, access.resource, access.where);
        return;
    }
    want(s, next.last_version);
}

void visit(CompileState& s, uint32_t pass) {
    for (const AccessRecord& access : s.graph->accesses(pass)) {
        if (!access.write) {
            want(s, access.version);
            const ResourceRecord& resource = s.graph->resources()[access.resource];
            if (resource.origin == Origin::kHistoryPrevious) want_history(s, access, resource);
        } else if (access.load == Load::kKeep || info(access.access).reads || !access.whole) {
            want(s, s.graph->versions()[access.version].previous);
        }
    }
}

/// Culled writers drop out of the chains that order the passes.
void link_live_writers(CompileState& s) {
    const auto versions = s.graph->versions();
    s.live_next.resize(versions.size());
    s.live_writer.resize(versions.size());
    const auto live = [&](uint32_t writer) {
        return writer != kNoIndex && s.plan->alive[writer] != 0;
    };
    // A version is numbered after the one it replaces.
    for (size_t v = 0; v < versions.size(); ++v) {
        const VersionRecord& version = versions[v];
        if (live(version.writer)) {
            s.live_writer[v] = version.writer;
        } else {
            s.live_writer[v] =
                version.previous == kNoIndex ? kNoIndex : s.live_writer[version.previous];
        }
    }
    for (size_t v = versions.size(); v-- > 0;) {
        const uint32_t next = versions[v].next;
        if (next == kNoIndex) {
            s.live_next[v] = kNoIndex;
        } else {
            s.live_next[v] =
                live(versions[next].writer) ? versions[next].writer : s.live_next[next];
        }
    }
}

}  // namespace

bool cull(CompileState& s) {
    const auto passes = s.graph->passes();
    const bool keep_all = s.options->switches.no_culling;
    s.plan->alive.assign(passes.size(), 0);
    s.needed.assign(s.graph->versions().size(), 0);
    s.stack.clear();
    for (uint32_t pass = 0; pass < passes.size(); ++pass) {
        if (!keep_all && !passes[pass].side_effect) continue;
        s.plan->alive[pass] = 1;
        s.stack.push_back(pass);
    }
    for (const OutputRecord& output : s.graph->outputs()) want(s, output.version);
    while (!s.stack.empty()) {
        const uint32_t pass = s.stack.back();
        s.stack.pop_back();
        visit(s, pass);
    }
    size_t live = 0;
    for (const uint8_t alive : s.plan->alive) live += alive;
    s.all_live = live == passes.size();
    if (!s.all_live) link_live_writers(s);
    for (const OutputRecord& output : s.graph->outputs()) {
        const uint32_t overwriter = s.next_writer(output.version);
        if (overwriter == kNoIndex) continue;
        s.report(Problem::kOutputOverwritten, kNoIndex,
                 s.graph->versions()[output.version].resource, output.where, overwriter);
    }
    return s.diagnostics->empty();
}

}  // namespace vellus::graph
