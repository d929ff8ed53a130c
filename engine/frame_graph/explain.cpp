#include <fmt/format.h>

#include <array>
#include <iterator>
#include <utility>

#include "engine/frame_graph/access.h"
#include "engine/frame_graph/description.h"
#include "engine/frame_graph/plan.h"

namespace vellus::graph {

namespace {

std::string_view name_of(Reason reason) {
    switch (reason) {
        case Reason::kFrameStart:
            return "memory is shared with the frames before";
        case Reason::kFirstUse:
            return "first use in the frame";
        case Reason::kAlias:
            return "takes over memory";
        case Reason::kReadAfterWrite:
            return "read after write";
        case Reason::kWriteAfterRead:
            return "write after read";
        case Reason::kWriteAfterWrite:
            return "write after write";
        case Reason::kLayoutChange:
            return "read again in another layout";
        case Reason::kFinalState:
            return "left as its owner expects";
        case Reason::kFullBarrier:
            return "full barriers are switched on";
    }
    return {};
}

std::string_view name_of(VkImageLayout layout) {
    switch (layout) {
        case VK_IMAGE_LAYOUT_UNDEFINED:
            return "undefined";
        case VK_IMAGE_LAYOUT_GENERAL:
            return "general";
        case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
            return "color attachment";
        case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
            return "depth attachment";
        case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL:
            return "depth read only";
        case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
            return "shader read only";
        case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
            return "transfer source";
        case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
            return "transfer destination";
        case VK_IMAGE_LAYOUT_PRESENT_SRC_KHR:
            return "present";
        default:
            return "other";
    }
}

std::string stage_names(uint32_t stages) {
    constexpr std::array<std::pair<uint32_t, std::string_view>, 11> kNames = {{
        {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, "indirect"},
        {VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, "vertex input"},
        {VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, "vertex"},
        {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, "fragment"},
        {VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT, "early tests"},
        {VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT, "late tests"},
        {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, "color output"},
        {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, "compute"},
        {VK_PIPELINE_STAGE_TRANSFER_BIT, "transfer"},
        {VK_PIPELINE_STAGE_HOST_BIT, "host"},
        {kAllStages, "all"},
    }};
    std::string names;
    for (const auto& [bit, name] : kNames) {
        if ((stages & bit) == 0) continue;
        if (!names.empty()) names += '+';
        names += name;
    }
    return names;
}

std::string step_name(const GraphDescription& graph, const Plan& plan, uint32_t step,
                      std::string_view none) {
    if (step >= plan.steps.size()) return std::string(none);
    const Step& s = plan.steps[step];
    if (s.kind == StepKind::kPoison) {
        return fmt::format("poison {}", graph.resources()[s.index].name);
    }
    return std::string(graph.passes()[s.index].name);
}

void append(std::string& out, const GraphDescription& graph, const Plan& plan,
            std::span<const Barrier> barriers) {
    for (const Barrier& barrier : barriers) {
        out += "    " + explain(graph, plan, barrier) + '\n';
    }
}

}  // namespace

std::string explain(const GraphDescription& graph, const Plan& plan, const Barrier& barrier) {
    const std::string from = step_name(graph, plan, barrier.from, "before the frame");
    const std::string to = step_name(graph, plan, barrier.to, "after the frame");
    std::string text;
    if (barrier.resource != kNoIndex) {
        const ResourceRecord& resource = graph.resources()[barrier.resource];
        text = fmt::format("'{}'", resource.name);
        if (resource.kind == ResourceKind::kImage && !barrier.global &&
            (resource.image.mips > 1 || resource.image.layers > 1)) {
            const ImageRange& r = barrier.range;
            text += fmt::format(" mips {}+{} layers {}+{}", r.mip, r.mips, r.layer, r.layers);
        }
    } else {
        text = "memory";
    }
    text += fmt::format(": {} [{}] -> {} [{}]", from, stage_names(barrier.src_stages), to,
                        stage_names(barrier.dst_stages));
    if (barrier.old_layout != barrier.new_layout) {
        text += fmt::format(", {} -> {}", name_of(barrier.old_layout), name_of(barrier.new_layout));
    }
    return fmt::format("{}: {}", text, name_of(barrier.reason));
}

std::string explain(const GraphDescription& graph, const Plan& plan) {
    std::string out = "frame starts\n";
    append(out, graph, plan, plan.prologue);
    for (uint32_t step = 0; step < plan.steps.size(); ++step) {
        append(out, graph, plan, plan.barriers_of(plan.steps[step]));
        out += fmt::format("{} {}\n", step, step_name(graph, plan, step, ""));
    }
    append(out, graph, plan, plan.epilogue);
    for (uint32_t pass = 0; pass < plan.alive.size(); ++pass) {
        if (!plan.alive[pass]) out += fmt::format("culled {}\n", graph.passes()[pass].name);
    }
    for (uint32_t i = 0; i < plan.placements.size(); ++i) {
        const Placement& p = plan.placements[i];
        if (p.pool == kNoIndex) continue;
        out += fmt::format("'{}' pool {} offset {} bytes {} steps {} to {}\n",
                           graph.resources()[i].name, p.pool, p.offset, p.bytes, p.first_step,
                           p.last_step == kNoIndex ? "the end" : std::to_string(p.last_step));
    }
    out += fmt::format("transient memory {} bytes, {} without aliasing\n", plan.transient_bytes,
                       plan.transient_unaliased_bytes);
    return out;
}

}  // namespace vellus::graph
