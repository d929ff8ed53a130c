#pragma once

#include <string_view>

namespace vellus {

/// A broken contract of the ECS, checked in every build: logs one line and aborts.
[[noreturn]] void contract_failed(std::string_view what);

}  // namespace vellus
