#include "tests/unit/frame_graph/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/frame_graph/access.h"

namespace vellus::graph::test {

namespace {

constexpr uint32_t kGarbage = ~0U;
constexpr uint32_t kDeviceStages = 0xffff & ~VK_PIPELINE_STAGE_HOST_BIT;

uint32_t expand_stages(uint32_t stages) {
    if (stages & VK_PIPELINE_STAGE_ALL_COMMANDS_BIT) {
        return stages | kDeviceStages;
    }
    return stages;
}

uint32_t expand_access(uint32_t access) {
    if (access & VK_ACCESS_MEMORY_WRITE_BIT) access |= kWriteBits;
    if (access & VK_ACCESS_MEMORY_READ_BIT) access |= 0xffffU & ~kWriteBits;
    return access;
}

bool subset(uint32_t part, uint32_t whole) {
    return (part & ~whole) == 0;
}

/// One past access at one stage, and what barriers have done for it since.
struct Record {
    uint32_t resource, sub;
    uint32_t stage;  // all bits must be waited for
    uint32_t access;
    bool write;
    bool available = false;
    uint32_t after = 0;                                    // stages ordered after it
    std::vector<std::pair<uint32_t, uint32_t>> visible{};  // stages x accesses
};

class Simulator {
  public:
    Simulator(const GraphDescription& graph, const Plan& plan) : graph_(graph), plan_(plan) {
        for (uint32_t r = 0; r < graph.resources().size(); ++r) {
            const ResourceRecord& resource = graph.resources()[r];
            first_.push_back(static_cast<uint32_t>(content_.size()));
            const bool kept =
                resource.origin == Origin::kHistoryPrevious || resource.before != Access::kNone;
            VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
            if (resource.kind == ResourceKind::kImage) {
                layout = resource.origin == Origin::kHistoryPrevious
                             ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                             : info(resource.before).layout;
            }
            for (uint32_t sub = 0; sub < sub_count(r); ++sub) {
                content_.push_back(kept ? resource.first_version : kGarbage);
                layout_.push_back(layout);
                // Whatever the frame before did, anywhere.
                records_.push_back({r, sub, kDeviceStages, VK_ACCESS_MEMORY_WRITE_BIT, true});
            }
        }
    }

    std::string run() {
        barriers(plan_.prologue);
        for (step_ = 0; step_ < plan_.steps.size() && error_.empty(); ++step_) {
            const Step& step = plan_.steps[step_];
            barriers(plan_.barriers_of(step));
            step.kind == StepKind::kPoison ? poison(step.index) : pass(step);
        }
        barriers(plan_.epilogue);
        if (error_.empty()) check_end();
        return error_;
    }

  private:
    uint32_t sub_count(uint32_t r) const {
        const ResourceRecord& resource = graph_.resources()[r];
        return resource.kind == ResourceKind::kBuffer ? 1
                                                      : resource.image.layers * resource.image.mips;
    }
    template <class F>
    void each_sub(uint32_t r, const ImageRange& range, const F& f) {
        if (graph_.resources()[r].kind == ResourceKind::kBuffer) return f(0U);
        for (uint32_t l = range.layer; l < uint32_t{range.layer} + range.layers; ++l) {
            for (uint32_t m = range.mip; m < uint32_t{range.mip} + range.mips; ++m) {
                f(l * graph_.resources()[r].image.mips + m);
            }
        }
    }
    bool covers(const ImageRange& range, uint32_t r, uint32_t sub) {
        bool found = false;
        each_sub(r, range, [&](uint32_t s) { found = found || s == sub; });
        return found;
    }
    bool share_memory(uint32_t a, uint32_t b) const {
        const Placement &p = plan_.placements[a], &q = plan_.placements[b];
        return a != b && p.pool != kNoIndex && p.pool == q.pool && p.offset < q.offset + q.bytes &&
               q.offset < p.offset + p.bytes;
    }
    void fail(std::string what, uint32_t r) {
        if (!error_.empty()) return;
        error_ = fmt::format("step {}: {} of '{}'", step_, what, graph_.resources()[r].name);
    }

    /// The version that last wrote this subresource as seen from `version`.
    uint32_t expected(uint32_t version, uint32_t sub) {
        while (true) {
            const VersionRecord& v = graph_.versions()[version];
            const ResourceRecord& resource = graph_.resources()[v.resource];
            if (v.writer == kNoIndex) {
                const bool kept =
                    resource.origin == Origin::kHistoryPrevious || resource.before != Access::kNone;
                return kept ? version : kGarbage;
            }
            for (const AccessRecord& access : graph_.accesses(v.writer)) {
                if (access.write && access.version == version &&
                    covers(access.range, v.resource, sub)) {
                    return version;
                }
            }
            version = v.previous;
        }
    }

    void clobber(uint32_t r) {
        for (uint32_t other = 0; other < graph_.resources().size(); ++other) {
            if (!share_memory(r, other)) continue;
            for (uint32_t s = 0; s < sub_count(other); ++s) content_[first_[other] + s] = kGarbage;
        }
    }

    void barriers(std::span<const Barrier> batch) {
        for (Record& record : records_) {
            uint32_t after = record.after;
            std::vector<const Barrier*> ordering;
            for (const Barrier& b : batch) {
                const uint32_t src = expand_stages(b.src_stages);
                if (!subset(record.stage, src) && (record.after & src) == 0) continue;
                after |= expand_stages(b.dst_stages);
                if (b.global || (b.resource == record.resource &&
                                 covers(b.range, record.resource, record.sub))) {
                    ordering.push_back(&b);
                }
            }
            record.after = after;
            for (const Barrier* b : ordering) {
                record.available =
                    record.available ||
                    (subset(record.stage, expand_stages(b->src_stages)) &&
                     subset(record.access & kWriteBits, expand_access(b->src_access)));
            }
            if (!record.available) continue;
            for (const Barrier* b : ordering) {
                record.visible.emplace_back(expand_stages(b->dst_stages),
                                            expand_access(b->dst_access));
            }
        }
        for (const Barrier& b : batch) {
            if (!b.global && b.old_layout != b.new_layout) transition(b);
        }
    }

    void transition(const Barrier& b) {
        if (graph_.resources()[b.resource].kind != ResourceKind::kImage) {
            return fail("layout transition", b.resource);
        }
        const uint32_t dst = expand_stages(b.dst_stages);
        each_sub(b.resource, b.range, [&](uint32_t sub) {
            const uint32_t cell = first_[b.resource] + sub;
            if (b.old_layout != VK_IMAGE_LAYOUT_UNDEFINED && b.old_layout != layout_[cell]) {
                fail("wrong old layout", b.resource);
            }
            if (b.old_layout == VK_IMAGE_LAYOUT_UNDEFINED) content_[cell] = kGarbage;
            layout_[cell] = b.new_layout;
            for (const Record& record : records_) {
                const bool same = record.resource == b.resource && record.sub == sub;
                if (!same && !share_memory(record.resource, b.resource)) continue;
                // Ordered by this very barrier, after whose source the transition happens.
                const uint32_t src = expand_stages(b.src_stages);
                const bool ordered = subset(record.stage, src) || (record.after & src) != 0;
                if (!ordered || (record.write && !record.available)) {
                    fail("unordered layout transition", b.resource);
                }
            }
            forget(b.resource, sub);
            records_.push_back(
                {b.resource, sub, 0, 0, true, true, dst, {{dst, expand_access(b.dst_access)}}});
        });
        if (b.old_layout == VK_IMAGE_LAYOUT_UNDEFINED) clobber(b.resource);
    }

    void forget(uint32_t r, uint32_t sub) {
        std::erase_if(records_, [&](const Record& x) { return x.resource == r && x.sub == sub; });
    }

    void check_hazards(uint32_t r, uint32_t sub, const AccessInfo& how, bool write) {
        for (uint32_t bit = 1; bit <= 0x10000; bit <<= 1) {
            if ((how.stages & bit) == 0) continue;
            for (const Record& record : records_) {
                const bool same = record.resource == r && record.sub == sub;
                if (!same && !share_memory(record.resource, r)) continue;
                if (!record.write && !write) continue;
                if ((record.after & bit) == 0) fail("access not ordered after an earlier one", r);
                if (!record.write) continue;
                if (!record.available) fail("access to a write not made available", r);
                const bool visible = std::ranges::any_of(record.visible, [&](const auto& v) {
                    return (v.first & bit) != 0 && subset(how.access, v.second);
                });
                if (same && !visible) fail("access to a write not made visible", r);
            }
        }
    }

    void record(uint32_t r, uint32_t sub, const AccessInfo& how, bool write) {
        if (write) forget(r, sub);
        for (uint32_t bit = 1; bit <= 0x10000; bit <<= 1) {
            if ((how.stages & bit) != 0) records_.push_back({r, sub, bit, how.access, write});
        }
    }

    void check_layout(uint32_t r, uint32_t sub, const AccessInfo& how) {
        if (graph_.resources()[r].kind == ResourceKind::kImage &&
            layout_[first_[r] + sub] != how.layout) {
            fail("access in the wrong layout", r);
        }
    }

    void check_alive(uint32_t r) {
        const Placement& p = plan_.placements[r];
        if (graph_.resources()[r].origin != Origin::kTransient) return;
        if (p.pool == kNoIndex || step_ < p.first_step || step_ > p.last_step) {
            fail("access outside the life", r);
        }
    }

    void poison(uint32_t r) {
        const AccessInfo& how = info(Access::kTransferWrite);
        check_alive(r);
        for (uint32_t sub = 0; sub < sub_count(r); ++sub) {
            check_layout(r, sub, how);
            check_hazards(r, sub, how, true);
            content_[first_[r] + sub] = kGarbage;
        }
        for (uint32_t sub = 0; sub < sub_count(r); ++sub) record(r, sub, how, true);
        clobber(r);
    }

    const Attachment* attachment_of(const Step& step, const AccessRecord& access) const {
        const uint32_t count = step.color_count + (step.has_depth ? 1 : 0);
        for (uint32_t i = 0; i < count; ++i) {
            const Attachment& a = plan_.attachments[step.first_attachment + i];
            if (a.resource == access.resource && a.range == access.range) return &a;
        }
        return nullptr;
    }

    void pass(const Step& step) {
        for (const AccessRecord& access : graph_.accesses(step.index)) {
            const AccessInfo& how = info(access.access);
            const uint32_t r = access.resource;
            check_alive(r);
            const bool keeps = access.load == Load::kKeep || how.reads;
            const uint32_t before =
                access.write ? graph_.versions()[access.version].previous : access.version;
            each_sub(r, access.range, [&](uint32_t sub) {
                check_layout(r, sub, how);
                check_hazards(r, sub, how, access.write);
                const uint32_t wanted = expected(before, sub);
                const bool matters = !access.write || (keeps && wanted != kGarbage) || how.reads;
                if (matters && (wanted == kGarbage || content_[first_[r] + sub] != wanted)) {
                    fail("wrong content read", r);
                }
            });
        }
        for (const AccessRecord& access : graph_.accesses(step.index)) write_back(step, access);
    }

    void write_back(const Step& step, const AccessRecord& access) {
        const AccessInfo& how = info(access.access);
        const Attachment* attachment = attachment_of(step, access);
        const bool needs_attachment = access.access == Access::kColorAttachment ||
                                      access.access == Access::kDepthAttachment ||
                                      access.access == Access::kDepthReadOnly;
        if (needs_attachment != (attachment != nullptr)) fail("attachment", access.resource);
        if (attachment && access.write && attachment->load.op != access.load) {
            fail("load op", access.resource);
        }
        each_sub(access.resource, access.range, [&](uint32_t sub) {
            record(access.resource, sub, how, access.write);
            if (!access.write) return;
            const bool kept = !attachment || attachment->store;
            content_[first_[access.resource] + sub] = kept ? access.version : kGarbage;
        });
        if (access.write) clobber(access.resource);
    }

    void check_end() {
        for (const OutputRecord& output : graph_.outputs()) {
            const uint32_t r = graph_.versions()[output.version].resource;
            for (uint32_t sub = 0; sub < sub_count(r); ++sub) {
                const uint32_t wanted = expected(output.version, sub);
                if (wanted != kGarbage && content_[first_[r] + sub] != wanted) {
                    fail("lost output", r);
                }
            }
        }
        for (uint32_t r = 0; r < graph_.resources().size(); ++r) {
            const ResourceRecord& resource = graph_.resources()[r];
            const bool written_history =
                resource.origin == Origin::kHistoryNext && plan_.placements[r].usage != 0;
            if (!written_history && resource.after == Access::kNone) continue;
            AccessInfo after = info(resource.after);
            if (written_history) {
                after.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
                after.stages = 0;
            }
            for (uint32_t sub = 0; sub < sub_count(r); ++sub) {
                check_layout(r, sub, after);
                if (after.access) check_hazards(r, sub, after, false);
                if (written_history && content_[first_[r] + sub] == kGarbage) {
                    fail("history without content", r);
                }
            }
        }
    }

    const GraphDescription& graph_;
    const Plan& plan_;
    std::vector<uint32_t> first_;  // cell of subresource 0, per resource
    std::vector<uint32_t> content_;
    std::vector<VkImageLayout> layout_;
    std::vector<Record> records_;
    uint32_t step_ = 0;
    std::string error_;
};

/// Passes that must run, by iterating the definition until nothing changes.
std::vector<uint8_t> passes_needed(const GraphDescription& graph, bool all) {
    const auto versions = graph.versions();
    std::vector<uint8_t> live(graph.passes().size(), all), needed(versions.size(), 0);
    for (size_t p = 0; p < live.size(); ++p) live[p] |= graph.passes()[p].side_effect;
    for (const OutputRecord& output : graph.outputs()) needed[output.version] = 1;
    for (bool changed = true; changed;) {
        const auto before = std::pair(live, needed);
        for (size_t v = 0; v < versions.size(); ++v) {
            if (needed[v] && versions[v].writer != kNoIndex) live[versions[v].writer] = 1;
        }
        for (const AccessRecord& access : graph.accesses()) {
            if (!live[access.pass]) continue;
            const ResourceRecord& resource = graph.resources()[access.resource];
            if (!access.write) {
                needed[access.version] = 1;
                if (resource.origin == Origin::kHistoryPrevious) {
                    needed[graph.resources()[resource.partner].last_version] = 1;
                }
                continue;
            }
            const bool part = resource.kind == ResourceKind::kImage &&
                              uint32_t{access.range.mips} * access.range.layers <
                                  resource.image.mips * resource.image.layers;
            if (access.load == Load::kKeep || part || info(access.access).reads) {
                needed[versions[access.version].previous] = 1;
            }
        }
        changed = before != std::pair(live, needed);
    }
    return live;
}

std::string check_memory(const GraphDescription& graph, const CompileOptions& options,
                         const Plan& plan) {
    uint64_t sum = 0;
    for (uint32_t r = 0; r < plan.placements.size(); ++r) {
        const Placement& p = plan.placements[r];
        if (p.pool == kNoIndex) continue;
        const MemoryNeeds needs =
            options.memory_needs(options.memory_user, graph.resources()[r], p.usage);
        const Pool& pool = plan.pools[p.pool];
        sum += p.bytes;
        if (p.bytes != needs.bytes || p.offset % needs.alignment != 0 ||
            p.offset + p.bytes > pool.bytes || pool.type_bits != needs.type_bits ||
            pool.kind != graph.resources()[r].kind) {
            return fmt::format("'{}' is placed where it must not be", graph.resources()[r].name);
        }
        for (uint32_t o = r + 1; o < plan.placements.size(); ++o) {
            const Placement& q = plan.placements[o];
            const bool meet =
                p.pool == q.pool && p.offset < q.offset + q.bytes && q.offset < p.offset + p.bytes;
            const bool together = p.first_step <= q.last_step && q.first_step <= p.last_step;
            if (meet && (together || options.switches.no_aliasing)) {
                return fmt::format("'{}' and '{}' overlap while both live",
                                   graph.resources()[r].name, graph.resources()[o].name);
            }
        }
    }
    return sum == plan.transient_unaliased_bytes ? "" : "unaliased bytes do not add up";
}

}  // namespace

std::string simulate(const GraphDescription& graph, const CompileOptions& options,
                     const Plan& plan) {
    if (passes_needed(graph, options.switches.no_culling) != plan.alive) return "wrong culling";
    std::vector<uint8_t> ran(plan.alive.size(), 0);
    for (const Step& step : plan.steps) {
        if (step.kind == StepKind::kPass && ran[step.index]++ != 0) return "a pass runs twice";
    }
    if (ran != plan.alive) return "not every live pass runs";
    if (std::string error = check_memory(graph, options, plan); !error.empty()) return error;
    return Simulator(graph, plan).run();
}

}  // namespace vellus::graph::test
