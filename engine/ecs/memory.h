#pragma once

#include <cstddef>

namespace vellus {

/// Gives a block of raw memory another size, keeping its contents up to the smaller one. Alignment
/// is that of malloc. Blocks of some MiB lie on huge pages where the system allows it, and grow by
/// remapping: their contents are never copied. Null and 0 bytes for none. Aborts when out of
/// memory.
void* resize_memory(void* old, size_t old_bytes, size_t bytes);

}  // namespace vellus
