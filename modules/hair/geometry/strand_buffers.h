#pragma once

#include "engine/gpu/buffer.h"
#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// A groom's columns on the device; see StrandData for what they hold.
struct StrandBuffers {
    gpu::Buffer positions;
    gpu::Buffer parameters;
    gpu::Buffer widths;  ///< empty where the width is constant
    gpu::Buffer colors;  ///< empty where the colour is constant
    gpu::Buffer segment_point;
    gpu::Buffer segment_strand;
    gpu::Buffer strand_seed;
    gpu::Buffer ambient;  ///< pack_ambient_depths(); empty until something draws with it
    uint32_t point_count = 0;
    uint32_t segment_count = 0;
    uint32_t strand_count = 0;

    /// Errors name the column that did not fit.
    static Result<StrandBuffers> upload(gpu::Device& device, const StrandData& strands);
    [[nodiscard]] uint64_t bytes() const;
};

}  // namespace vellus::hair
