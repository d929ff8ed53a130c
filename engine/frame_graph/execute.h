#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/frame_graph/compile.h"
#include "engine/gpu/device.h"

namespace vellus::graph {

/// What one pass cost. Device times lie back to back, so that they add up to the frame; on a
/// device that is a CPU they are CPU time.
struct PassReport {
    std::string name;
    double gpu_ms = 0;
    double cpu_ms = 0;  ///< recording
    uint32_t draws = 0;
    uint32_t dispatches = 0;
};

struct MemoryReport {
    uint64_t transient_bytes = 0;
    uint64_t transient_unaliased_bytes = 0;  ///< without sharing of memory
    uint64_t persistent_bytes = 0;           ///< everything else on the device, history included
};

struct FrameReport {
    uint64_t index = 0;
    double gpu_ms = 0;
    double unattributed_ms = 0;  ///< device time that is of no pass
    double compile_ms = 0;
    double record_ms = 0;
    std::vector<PassReport> passes;  ///< in execution order
    MemoryReport memory;
};

/// For presentation: what the frame waits for before it starts, and tells when it is done.
struct FrameSync {
    VkSemaphore wait = VK_NULL_HANDLE;
    VkSemaphore signal = VK_NULL_HANDLE;
};

/// Runs described frames on a device: compiles, places transient resources in shared memory,
/// records and submits. Everything is kept for the next frame; a steady frame creates nothing.
class Executor {
  public:
    /// `frames_in_flight` is how far the CPU may run ahead.
    static Result<std::unique_ptr<Executor>> create(gpu::Device& device,
                                                    uint32_t frames_in_flight = 2);
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    /// Debugging switches, obeyed from the next frame on.
    Switches& switches();

    /// Waits until the oldest frame in flight is done: what that frame read may be written again.
    /// execute() calls it where the caller has not.
    Result<void> begin_frame();
    /// Errors name pass, resource and line of what the description did wrong, or the resource that
    /// could not be made.
    Result<void> execute(const GraphDescription& graph, const FrameSync& sync = {});
    /// Waits for all frames in flight.
    Result<void> wait();

    /// The newest frame that is done; after wait(), the last one executed.
    [[nodiscard]] const FrameReport& report() const;
    /// The plan of the last frame executed.
    [[nodiscard]] const Plan& plan() const;
    /// Vulkan objects made so far: constant in steady frames.
    [[nodiscard]] uint64_t objects_created() const;

  private:
    struct State;
    explicit Executor(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace vellus::graph
