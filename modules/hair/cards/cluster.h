#pragma once

#include <cstdint>
#include <vector>

#include "modules/hair/groom/strand_data.h"

namespace vellus::hair {

/// Assigns each strand to one of at most `count` clusters of strands that run side by side: k-means
/// (Lloyd 1982) over the mean positions of eight pieces of equal length, which hold root, direction
/// and length; started from the strands farthest from each other (Gonzalez 1985). No cluster is
/// empty. The same input gives the same labels on any number of cores.
std::vector<uint32_t> cluster_strands(const StrandData& strands, uint32_t count);

}  // namespace vellus::hair
