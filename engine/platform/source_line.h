#pragma once

#include <cstdint>

namespace vellus {

/// A line of source text; the default argument SourceLine::current() is the caller's. (clang 14 has
/// no std::source_location.)
struct SourceLine {
    const char* file = "";
    uint32_t line = 0;
    static constexpr SourceLine current(const char* file = __builtin_FILE(),
                                        uint32_t line = __builtin_LINE()) {
        return {file, line};
    }
};

}  // namespace vellus
