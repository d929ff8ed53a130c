#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

/// Marks the pass that writes the version; cull() comes to it later if it is declared before
/// `cursor`, else the stack keeps it.
inline void want(CompileState& s, uint32_t version, uint32_t cursor) {
    s.needed[version] = 1;
    const uint32_t writer = s.graph->versions()[version].writer;
    if (writer == kNoIndex || s.plan->alive[writer]) return;
    s.plan->alive[writer] = 1;
    if (writer >= cursor) s.stack.push_back(writer);
}

/// Who reads last frame's image needs this frame's to be written.
void want_history(CompileState& s, const AccessRecord& access, const ResourceRecord& previous,
                  uint32_t cursor) {
    const ResourceRecord& next = s.graph->resources()[previous.partner];
    if (next.last_version == next.first_version) {
        s.report(Problem::kMissingHistory, access.pass, access.resource, access.where);
        return;
    }
    want(s, next.last_version, cursor);
}

inline void visit(CompileState& s, uint32_t pass, uint32_t cursor) {
    for (const AccessRecord& access : s.graph->accesses(pass)) {
        if (!access.write) {
            want(s, access.version, cursor);
            if (s.graph->externals().empty()) continue;
            const ResourceRecord& resource = s.graph->resources()[access.resource];
            if (resource.origin == Origin::kHistoryPrevious) {
                want_history(s, access, resource, cursor);
            }
        } else if (access.load == Load::kKeep || info(access.access).reads || !access.whole) {
            want(s, s.graph->versions()[access.version].previous, cursor);
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
    const auto count = static_cast<uint32_t>(passes.size());
    s.plan->alive.assign(count, keep_all ? 1 : 0);
    s.needed.assign(s.graph->versions().size(), 0);
    s.stack.clear();
    for (const OutputRecord& output : s.graph->outputs()) want(s, output.version, count);
    // Backwards, what is declared in order needs no stack.
    uint32_t live = 0;
    for (uint32_t cursor = count; cursor-- > 0;) {
        if (passes[cursor].side_effect) s.plan->alive[cursor] = 1;
        if (!s.plan->alive[cursor]) continue;
        ++live;
        visit(s, cursor, cursor);
        while (!s.stack.empty()) {
            const uint32_t pass = s.stack.back();
            s.stack.pop_back();
            ++live;
            visit(s, pass, cursor);
        }
    }
    s.all_live = live == count;
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
