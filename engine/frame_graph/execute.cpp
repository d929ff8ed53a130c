#include "engine/frame_graph/execute.h"

#include <bit>
#include <chrono>

#include "engine/frame_graph/frame_slot.h"
#include "engine/frame_graph/history_store.h"
#include "engine/frame_graph/record.h"
#include "engine/gpu/buffer.h"

namespace vellus::graph {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::array<uint32_t, kFormatCount> format_usage(gpu::Device& device) {
    std::array<uint32_t, kFormatCount> usage{};
    for (size_t i = 1; i < kFormatCount; ++i) {
        usage[i] = gpu::usable_as(device, static_cast<gpu::Format>(i));
    }
    return usage;
}

}  // namespace

struct Executor::State {
    explicit State(gpu::Device& d)
        : device(d), graveyard(d), heap(d, graveyard), history(d, graveyard) {}

    Result<void> begin_frame();
    Result<void> execute(const GraphDescription& graph, const FrameSync& sync);
    Result<void> prepare(const GraphDescription& graph);
    void bind_imports(const GraphDescription& graph);
    Result<void> record(const GraphDescription& graph, FrameSlot& slot, const FrameSync& sync);
    Result<void> record_step(const GraphDescription& graph, FrameSlot& slot, const Step& step);
    Result<void> make_placeholder();
    Error mistakes(const GraphDescription& graph) const;
    Result<void> finish(FrameSlot& slot);

    gpu::Device& device;
    Graveyard graveyard;
    TransientHeap heap;
    HistoryStore history;
    Switches switches;
    std::array<uint32_t, kFormatCount> formats{};
    Compiler compiler;
    Plan plan;
    Diagnostics diagnostics;
    Recorder recorder;
    std::vector<Physical> physical;
    std::vector<uint32_t> history_clears;
    std::vector<FrameSlot> slots;
    gpu::Image placeholder_image;
    gpu::Buffer placeholder_buffer;
    FrameReport report;
    uint64_t frame = 1;  // the frame to execute next; callers count from 0
    uint64_t created = 0;
    bool begun = false;
};

Result<void> Executor::State::make_placeholder() {
    auto image = gpu::Image::create(device, {}, "placeholder");
    if (!image) return image.error();
    placeholder_image = std::move(*image);
    auto buffer = gpu::Buffer::create(device, 256, gpu::MemoryKind::kDevice, "placeholder");
    if (!buffer) return buffer.error();
    placeholder_buffer = std::move(*buffer);
    return {};
}

Error Executor::State::mistakes(const GraphDescription& graph) const {
    return {describe(graph, diagnostics), "frame graph", ""};
}

Result<void> Executor::State::finish(FrameSlot& slot) {
    if (!slot.in_flight()) return {};
    if (auto done = slot.wait(); !done) return done;
    slot.collect(report);
    graveyard.bury(report.index + 1);
    return {};
}

Result<void> Executor::State::begin_frame() {
    if (begun) return {};
    FrameSlot& slot = slots[frame % slots.size()];
    if (auto done = finish(slot); !done) return done;
    begun = true;
    return {};
}

void Executor::State::bind_imports(const GraphDescription& graph) {
    for (uint32_t i = 0; i < physical.size(); ++i) {
        const ResourceRecord& resource = graph.resources()[i];
        if (resource.origin != Origin::kImported) continue;
        Physical& p = physical[i];
        if (resource.native_image) {
            p.image = std::bit_cast<VkImage>(resource.native_image);
            p.whole = std::bit_cast<VkImageView>(resource.native_view);
        } else if (resource.kind == ResourceKind::kImage && resource.external) {
            const auto& image = *static_cast<const gpu::Image*>(resource.external);
            p.image = image.handle();
            p.whole = image.view();
        } else if (resource.external) {
            const auto& buffer = *static_cast<const gpu::Buffer*>(resource.external);
            p.buffer = buffer.handle();
            p.address = buffer.address();
        }
    }
}

Result<void> Executor::State::prepare(const GraphDescription& graph) {
    const CompileOptions options{
        .switches = switches,
        .memory_needs =
            [](const void* user, const ResourceRecord& resource, uint32_t usage) {
                return static_cast<TransientHeap*>(const_cast<void*>(user))->needs(resource, usage);
            },
        .memory_user = &heap,
        .format_usage = &formats};
    if (!compiler.compile(graph, options, plan, diagnostics)) return mistakes(graph);
    physical.assign(graph.resources().size(), {});
    history_clears.clear();
    if (auto bound = heap.bind(graph, plan, frame, physical); !bound) return bound;
    if (auto bound = history.bind(graph, plan, frame, physical, history_clears); !bound) {
        return bound;
    }
    bind_imports(graph);
    recorder.begin({.device = &device,
                    .graph = &graph,
                    .plan = &plan,
                    .physical = &physical,
                    .graveyard = &graveyard,
                    .diagnostics = &diagnostics,
                    .frame = frame,
                    .created = &created,
                    .placeholder = {.image = placeholder_image.handle(),
                                    .buffer = placeholder_buffer.handle(),
                                    .address = placeholder_buffer.address(),
                                    .whole = placeholder_image.view()}});
    return {};
}

Result<void> Executor::State::record_step(const GraphDescription& graph, FrameSlot& slot,
                                          const Step& step) {
    const bool is_pass = step.kind == StepKind::kPass;
    const bool host = is_pass && graph.passes()[step.index].kind == PassKind::kHost;
    const std::string_view name =
        is_pass ? graph.passes()[step.index].name : graph.resources()[step.index].name;
    const auto start = Clock::now();
    slot.begin_label(name);
    recorder.barriers(slot.commands(), plan.barriers_of(step));
    if (host) {
        slot.end_label();
        if (auto done = slot.flush(); !done) return done;
        slot.begin_label(name);
    }
    gpu::CommandBuffer commands(slot.commands());
    if (is_pass) {
        recorder.pass(commands, step);
    } else {
        recorder.poison(slot.commands(), step.index);
    }
    slot.end_label();
    slot.mark();
    PassReport& cost = slot.add_pass(name);
    cost.draws = commands.draws();
    cost.dispatches = commands.dispatches();
    cost.cpu_ms = ms_since(start);
    if (!is_pass) cost.name.insert(0, "poison ");
    return switches.immediate ? slot.flush() : Result<void>{};
}

Result<void> Executor::State::record(const GraphDescription& graph, FrameSlot& slot,
                                     const FrameSync& sync) {
    const auto start = Clock::now();
    if (auto begun_slot = slot.begin(frame, plan.steps.size(), sync.wait); !begun_slot) {
        return begun_slot;
    }
    slot.mark();
    recorder.clear_history(slot.commands(), history_clears);
    recorder.barriers(slot.commands(), plan.prologue);
    slot.mark();
    for (const Step& step : plan.steps) {
        if (auto recorded = record_step(graph, slot, step); !recorded) return recorded;
    }
    recorder.barriers(slot.commands(), plan.epilogue);
    slot.mark();
    if (!diagnostics.empty()) {
        slot.abandon();
        return mistakes(graph);
    }
    if (recorder.failure() != VK_SUCCESS) {
        slot.abandon();
        return gpu::vulkan_error(recorder.failure(), "recording the frame");
    }
    slot.report().record_ms = ms_since(start);
    return slot.submit(sync.signal);
}

Result<void> Executor::State::execute(const GraphDescription& graph, const FrameSync& sync) {
    if (auto ready = begin_frame(); !ready) return ready;
    begun = false;
    FrameSlot& slot = slots[frame % slots.size()];
    const auto start = Clock::now();
    if (auto prepared = prepare(graph); !prepared) return prepared;
    slot.report().compile_ms = ms_since(start);
    if (auto recorded = record(graph, slot, sync); !recorded) return recorded;
    history.advance(graph, plan, frame);
    slot.report().memory = {.transient_bytes = plan.transient_bytes,
                            .transient_unaliased_bytes = plan.transient_unaliased_bytes,
                            .persistent_bytes = device.memory().bytes_in_use() - heap.bytes_held()};
    heap.trim(frame);
    history.trim(frame);
    ++frame;
    return {};
}

Executor::Executor(std::unique_ptr<State> state) : state_(std::move(state)) {}
Executor::~Executor() {
    if (state_) static_cast<void>(wait());
}

Result<std::unique_ptr<Executor>> Executor::create(gpu::Device& device, uint32_t frames_in_flight) {
    auto state = std::make_unique<State>(device);
    state->formats = format_usage(device);
    if (auto made = state->make_placeholder(); !made) return made.error();
    for (uint32_t i = 0; i < std::max(frames_in_flight, 1U); ++i) {
        auto slot = FrameSlot::create(device);
        if (!slot) return slot.error();
        state->slots.push_back(std::move(*slot));
    }
    return std::unique_ptr<Executor>(new Executor(std::move(state)));
}

Switches& Executor::switches() {
    return state_->switches;
}
Result<void> Executor::begin_frame() {
    return state_->begin_frame();
}
Result<void> Executor::execute(const GraphDescription& graph, const FrameSync& sync) {
    return state_->execute(graph, sync);
}

Result<void> Executor::wait() {
    for (uint64_t i = 0; i < state_->slots.size(); ++i) {  // oldest first
        FrameSlot& slot = state_->slots[(state_->frame + i) % state_->slots.size()];
        if (auto done = state_->finish(slot); !done) return done;
    }
    return {};
}

const FrameReport& Executor::report() const {
    return state_->report;
}
const Plan& Executor::plan() const {
    return state_->plan;
}
uint64_t Executor::objects_created() const {
    return state_->created + state_->heap.created() + state_->history.created();
}

}  // namespace vellus::graph
