#include "modules/hair/geometry/strand_buffers.h"

#include <limits>

namespace vellus::hair {

namespace {

template <class T>
Result<void> upload_column(gpu::Device& device, const std::vector<T>& column, const char* name,
                           gpu::Buffer& out) {
    auto buffer = gpu::Buffer::upload_span(device, std::span(column), name);
    if (!buffer) return buffer.error();
    out = std::move(*buffer);
    return {};
}

}  // namespace

Result<StrandBuffers> StrandBuffers::upload(gpu::Device& device, const StrandData& strands) {
    // Segment ids share 32 bits with "no segment", and shaders index points with 32 bits.
    if (strands.positions.size() >= std::numeric_limits<uint32_t>::max() / 2) {
        return Error{fmt::format("has {} points; at most {} can be drawn", strands.positions.size(),
                                 std::numeric_limits<uint32_t>::max() / 2),
                     "groom", "use fewer strands"};
    }
    StrandBuffers buffers;
    const Result<void> steps[] = {
        upload_column(device, strands.positions, "hair positions", buffers.positions),
        upload_column(device, strands.point_parameter, "hair parameters", buffers.parameters),
        upload_column(device, strands.point_width, "hair widths", buffers.widths),
        upload_column(device, strands.point_color, "hair colours", buffers.colors),
        upload_column(device, strands.segment_point, "hair segments", buffers.segment_point),
        upload_column(device, strands.segment_strand, "hair segment strands",
                      buffers.segment_strand),
        upload_column(device, strands.strand_seed, "hair seeds", buffers.strand_seed),
    };
    for (const auto& step : steps) {
        if (!step) return step.error();
    }
    buffers.point_count = static_cast<uint32_t>(strands.positions.size());
    buffers.segment_count = static_cast<uint32_t>(strands.segment_count());
    buffers.strand_count = static_cast<uint32_t>(strands.strand_count());
    return buffers;
}

uint64_t StrandBuffers::bytes() const {
    return positions.bytes() + parameters.bytes() + widths.bytes() + colors.bytes() +
           segment_point.bytes() + segment_strand.bytes() + strand_seed.bytes() + ambient.bytes();
}

}  // namespace vellus::hair
