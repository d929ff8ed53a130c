#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

namespace vellus {

/// The type's name as the compiler spells it, for messages.
template <class T>
constexpr std::string_view type_name() {
    const std::string_view text = __PRETTY_FUNCTION__;
    const size_t first = text.find("T = ") + 4;
    return text.substr(first, text.find_first_of(";]", first) - first);
}

template <class Family>
uint32_t next_type_index() {
    static std::atomic<uint32_t> last{0};
    return ++last;
}

/// A dense number for T within a family, from 1, given out before main; 0 means "used before that".
template <class Family, class... T>
inline const uint32_t kTypeIndex = next_type_index<Family>();

struct ComponentFamily;
struct ResourceFamily;
struct BundleFamily;
struct QueryFamily;

}  // namespace vellus
