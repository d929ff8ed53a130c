#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/ecs/ecs.h"
#include "engine/frame_graph/execute.h"
#include "engine/gpu/buffer.h"
#include "modules/hair/groom/strand_data.h"
#include "modules/hair/techniques.h"

namespace vellus::bench {

struct HairRigOptions {
    std::string groom = "../shared/data/hair/straight.hair";
    /// Drawn instead of the file; needed by create() only.
    const hair::StrandData* strands = nullptr;
    std::string device;
    uint32_t width = 1280;
    uint32_t height = 720;
    bool temporal = true;
    /// White hair under an even white sky before black, unshadowed: brightness is coverage.
    bool white = false;
    /// Its roots on a sphere of 2,000 vertices and two joints, which nods a little in each frame.
    bool bound = false;
    hair::HairTechniques techniques;
};

/// What a frame is asked for; the frame graph culls the rest.
enum class Wanted : uint8_t { kPicture, kLinear, kClosestSegment };

/// One groom, framed to fill the picture under the default sun and sky, drawn with all modules.
class HairRig {
  public:
    static Result<std::unique_ptr<HairRig>> create(const HairRigOptions& options);
    ~HairRig();
    HairRig(const HairRig&) = delete;
    HairRig& operator=(const HairRig&) = delete;

    /// Draws one frame and waits for it.
    Result<void> draw(Wanted wanted);
    /// After draw(kLinear): green of each pixel. After draw(kClosestSegment): 1 where there is
    /// hair.
    [[nodiscard]] std::vector<float> values() const;
    [[nodiscard]] const graph::FrameReport& report() const { return executor_->report(); }
    [[nodiscard]] gpu::Device& device() { return *device_; }
    [[nodiscard]] uint64_t objects_created() const;

  private:
    HairRig() = default;
    Result<void> set_up(const HairRigOptions& options);
    Result<void> bind(Entity hair, uint32_t groom);
    void nod();
    void read_back(Wanted wanted);

    std::unique_ptr<gpu::Device> device_;
    World world_;
    Schedule schedule_{"frame"};
    std::unique_ptr<graph::Executor> executor_;
    gpu::Buffer readback_;
    Entity nodding_ = kNoEntity;
    Wanted last_ = Wanted::kPicture;
    size_t pixels_ = 0;
};

}  // namespace vellus::bench
