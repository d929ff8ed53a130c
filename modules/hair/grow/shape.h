#pragma once

#include "modules/hair/grow/strands.h"

namespace vellus::hair::grow {

/// The lock and the wisp (a smaller lock) each strand belongs to: indices of the strands they
/// gather around, which are among the first.
struct Locks {
    std::vector<uint32_t> lock;
    std::vector<uint32_t> wisp;
};
Locks find_locks(const GrowSettings& settings, double area, const std::vector<Root>& roots,
                 const std::vector<double>& from_parting);

/// Pulls strands towards the middle of their wisp and lock, more towards the tip.
void clump(const Ground& ground, const Locks& locks, Strands& strands);

/// Curl, then frizz of the single hair, then out of body and face again.
void curl_and_settle(const Ground& ground, const Locks& locks, const std::vector<Root>& roots,
                     bool gathered, Strands& strands);

}  // namespace vellus::hair::grow
