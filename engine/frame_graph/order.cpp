#include <algorithm>
#include <numeric>

#include "engine/frame_graph/compile_state.h"

namespace vellus::graph {

namespace {

/// Calls edge(before, after, access) for every order the live passes must keep.
template <class F>
void for_each_edge(const CompileState& s, const F& edge) {
    const auto versions = s.graph->versions();
    for (uint32_t pass = 0; pass < s.plan->alive.size(); ++pass) {
        if (!s.plan->alive[pass]) continue;
        for (const AccessRecord& access : s.graph->accesses(pass)) {
            const uint32_t source =
                access.write ? versions[access.version].previous : access.version;
            const uint32_t writer = s.last_writer(source);
            if (writer != kNoIndex && writer != pass) edge(writer, pass, access);
            const uint32_t overwriter = access.write ? kNoIndex : s.next_writer(access.version);
            if (overwriter != kNoIndex && overwriter != pass) edge(pass, overwriter, access);
        }
    }
}

void build_edges(CompileState& s) {
    const size_t count = s.plan->alive.size();
    s.edge_first.assign(count + 1, 0);
    s.edge_count.assign(count, 0);  // edges into a pass
    for_each_edge(s, [&](uint32_t before, uint32_t after, const AccessRecord&) {
        ++s.edge_first[before + 1];
        ++s.edge_count[after];
    });
    for (size_t i = 0; i < count; ++i) s.edge_first[i + 1] += s.edge_first[i];
    s.edge_to.resize(s.edge_first[count]);
    s.edge_next.assign(s.edge_first.begin(), s.edge_first.end() - 1);
    for_each_edge(s, [&](uint32_t before, uint32_t after, const AccessRecord&) {
        s.edge_to[s.edge_next[before]++] = after;
    });
}

/// SplitMix64: the same sequence on every platform.
uint64_t next_random(uint64_t& state) {
    uint64_t z = state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

/// Kahn's algorithm; ready passes are taken as declared, or at random.
void sort(CompileState& s, size_t live) {
    const bool random = s.options->switches.random_order;
    uint64_t state = s.options->switches.seed;
    std::vector<uint32_t>& ready = s.stack;
    ready.clear();
    const auto add = [&](uint32_t pass) {
        ready.push_back(pass);
        if (!random) std::ranges::push_heap(ready, std::greater<>());
    };
    for (uint32_t pass = 0; pass < s.plan->alive.size(); ++pass) {
        if (s.plan->alive[pass] && s.edge_count[pass] == 0) add(pass);
    }
    s.order.clear();
    while (!ready.empty() && s.order.size() < live) {
        if (random) {
            std::swap(ready[next_random(state) % ready.size()], ready.back());
        } else {
            std::ranges::pop_heap(ready, std::greater<>());
        }
        const uint32_t pass = ready.back();
        ready.pop_back();
        s.order.push_back(pass);
        for (uint32_t e = s.edge_first[pass]; e < s.edge_first[pass + 1]; ++e) {
            if (--s.edge_count[s.edge_to[e]] == 0) add(s.edge_to[e]);
        }
    }
}

/// Names one edge of one cycle among the passes that could not be ordered.
void report_cycle(CompileState& s) {
    // From a pass that waits, step to one it waits for, until a pass comes up twice.
    std::vector<uint32_t> waits_for(s.plan->alive.size(), kNoIndex);
    std::vector<const AccessRecord*> because(s.plan->alive.size(), nullptr);
    const auto waits = [&](uint32_t pass) { return s.edge_count[pass] > 0; };
    uint32_t pass = kNoIndex;
    for_each_edge(s, [&](uint32_t before, uint32_t after, const AccessRecord& access) {
        if (!waits(before) || !waits(after)) return;
        waits_for[after] = before;
        because[after] = &access;
        pass = after;
    });
    std::vector<uint8_t> seen(s.plan->alive.size(), 0);
    while (!seen[pass]) {
        seen[pass] = 1;
        pass = waits_for[pass];
    }
    const AccessRecord& access = *because[pass];
    const uint32_t other = access.pass == pass ? waits_for[pass] : pass;
    s.report(Problem::kCycle, access.pass, access.resource, access.where, other);
}

}  // namespace

bool order_passes(CompileState& s) {
    if (s.in_declared_order()) {
        s.order.resize(s.plan->alive.size());
        std::iota(s.order.begin(), s.order.end(), 0U);
        return true;
    }
    size_t live = 0;
    for (const uint8_t alive : s.plan->alive) live += alive;
    if (!s.options->switches.random_order) {
        // Declared order nearly always is an order of execution.
        bool forward = true;
        for_each_edge(s, [&](uint32_t before, uint32_t after, const AccessRecord&) {
            forward = forward && before < after;
        });
        if (forward) {
            s.order.clear();
            for (uint32_t pass = 0; pass < s.plan->alive.size(); ++pass) {
                if (s.plan->alive[pass]) s.order.push_back(pass);
            }
            return true;
        }
    }
    build_edges(s);
    sort(s, live);
    if (s.order.size() == live) return true;
    report_cycle(s);
    return false;
}

}  // namespace vellus::graph
