#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

/// Walks back from what is asked for. It keeps its arrays at hand: a byte written to `needed` or
/// `alive` might be any of the state's pointers, as far as the compiler knows.
class Walk {
  public:
    explicit Walk(CompileState& s)
        : s_(s),
          resources_(s.graph->resources()),
          versions_(s.graph->versions()),
          passes_(s.graph->passes()),
          accesses_(s.graph->accesses()),
          history_(!s.graph->externals().empty()),
          needed_(s.needed),
          alive_(s.plan->alive) {}

    /// Marks the pass that writes the version; run() comes to it later if it is declared before
    /// `cursor`, else the stack keeps it.
    void want(uint32_t version, uint32_t cursor) {
        needed_[version] = 1;
        const uint32_t writer = versions_[version].writer;
        if (writer == kNoIndex || alive_[writer]) return;
        alive_[writer] = 1;
        if (writer >= cursor) s_.stack.push_back(writer);
    }

    /// Backwards, what is declared in order needs no stack. Returns how many passes live.
    uint32_t run() {
        uint32_t live = 0;
        for (auto cursor = static_cast<uint32_t>(passes_.size()); cursor-- > 0;) {
            if (passes_[cursor].side_effect) alive_[cursor] = 1;
            if (!alive_[cursor]) continue;
            ++live;
            visit(cursor, cursor);
            while (!s_.stack.empty()) {
                const uint32_t pass = s_.stack.back();
                s_.stack.pop_back();
                ++live;
                visit(pass, cursor);
            }
        }
        return live;
    }

  private:
    void visit(uint32_t pass, uint32_t cursor) {
        const PassRecord& record = passes_[pass];
        for (const AccessRecord& access :
             accesses_.subspan(record.first_access, record.access_count)) {
            if (!access.write) {
                want(access.version, cursor);
                if (history_) want_history(access, cursor);
            } else if (access.load == Load::kKeep || info(access.access).reads || !access.whole) {
                want(versions_[access.version].previous, cursor);
            }
        }
    }

    /// Who reads last frame's image needs this frame's to be written.
    void want_history(const AccessRecord& access, uint32_t cursor) {
        const ResourceRecord& previous = resources_[access.resource];
        if (previous.origin != Origin::kHistoryPrevious) return;
        const ResourceRecord& next = resources_[previous.partner];
        if (next.last_version == next.first_version) {
            s_.report(Problem::kMissingHistory, access.pass, access.resource, access.where);
            return;
        }
        want(next.last_version, cursor);
    }

    CompileState& s_;
    std::span<const ResourceRecord> resources_;
    std::span<const VersionRecord> versions_;
    std::span<const PassRecord> passes_;
    std::span<const AccessRecord> accesses_;
    bool history_;
    std::span<uint8_t> needed_;
    std::span<uint8_t> alive_;
};

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
    const auto count = static_cast<uint32_t>(s.graph->passes().size());
    s.plan->alive.assign(count, s.options->switches.no_culling ? 1 : 0);
    s.needed.assign(s.graph->versions().size(), 0);
    s.stack.clear();
    Walk walk(s);
    for (const OutputRecord& output : s.graph->outputs()) walk.want(output.version, count);
    s.all_live = walk.run() == count;
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
