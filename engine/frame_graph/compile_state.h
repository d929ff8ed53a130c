#pragma once

// What the phases of compile() share. Internal to this folder.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/frame_graph/access.h"
#include "engine/frame_graph/compile.h"
#include "engine/frame_graph/memory_map.h"

namespace vellus::graph {

/// Where synchronization of one subresource stands.
struct SyncState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    uint32_t write_stages = 0;  ///< the last write, or what a layout transition was ordered before
    uint32_t write_access = 0;
    uint32_t read_stages = 0;  ///< reads since that write
    uint32_t visible_stages = 0;
    uint32_t visible_access = 0;
    uint32_t last_step = kNoIndex;
    bool defined = false;  ///< a pass has written it, or it came with content
    bool operator==(const SyncState&) const = default;
};

struct ResourceState {
    SyncState whole;
    uint32_t split = kNoIndex;  ///< into sub_states, layer-major, once ranges differ
    uint32_t block = kNoIndex;  ///< node of the pool's memory map; of a transient one
    bool aliased = false;       ///< `whole` is the former owners' until the first use waits for it
};

/// The state history images are kept in between frames.
constexpr VkImageLayout kHistoryLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

struct CompileState {
    const GraphDescription* graph = nullptr;
    const CompileOptions* options = nullptr;
    Plan* plan = nullptr;
    Diagnostics* diagnostics = nullptr;
    bool full_barriers = false;

    std::vector<uint8_t> needed;      // per version: its content is read later or asked for
    std::vector<uint32_t> live_next;  // per version: the live pass that overwrites it
    std::vector<uint32_t>
        live_writer;              // per version: the live pass that wrote it, or the last before
    bool all_live = false;        // no pass is culled: what is live_ is not filled
    std::vector<uint32_t> stack;  // passes to visit
    std::vector<uint32_t> order;  // live passes, in execution order
    std::vector<uint32_t> edge_first, edge_to, edge_count, edge_next;
    std::vector<Readers> live_readers;  // per version; unless all passes live
    std::vector<ResourceState> states;  // per resource; of a transient one once it is placed
    std::vector<SyncState> sub_states;
    std::vector<MemoryMap> maps;  // per pool; more than in use are kept for their memory

    /// Every pass runs, where it is declared.
    [[nodiscard]] bool in_declared_order() const {
        return all_live && graph->in_order() && !options->switches.random_order;
    }
    /// The live pass that overwrites this version, or kNoIndex.
    [[nodiscard]] uint32_t next_writer(uint32_t version) const {
        if (!all_live) return live_next[version];
        const uint32_t next = graph->versions()[version].next;
        return next == kNoIndex ? kNoIndex : graph->versions()[next].writer;
    }
    /// The live pass that wrote this version or, where that is culled, the last one before.
    [[nodiscard]] uint32_t last_writer(uint32_t version) const {
        return all_live ? graph->versions()[version].writer : live_writer[version];
    }

    /// All live reads of this version.
    [[nodiscard]] const Readers& readers(uint32_t version) const {
        return all_live ? graph->versions()[version].readers : live_readers[version];
    }

    void report(Problem problem, uint32_t pass, uint32_t resource, SourceLine where,
                uint32_t other = kNoIndex) const {
        diagnostics->push_back({problem, pass, resource, other, where});
    }
};

// The phases, in order. Each returns false after reporting what stops the compilation.
bool validate(CompileState& s);
bool cull(CompileState& s);
bool order_passes(CompileState& s);
void find_lifetimes(CompileState& s);
bool schedule(CompileState& s);

/// Places a resource for its first use; its block carries who had the memory before.
void place(CompileState& s, uint32_t resource);
/// Gives the memory back, tagged with the accesses that must end before it is used again.
void release(CompileState& s, uint32_t resource);
void begin_placement(CompileState& s);
void end_placement(CompileState& s);

}  // namespace vellus::graph
