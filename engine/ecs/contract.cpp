#include "engine/ecs/contract.h"

#include <cstdlib>

#include "engine/platform/log.h"

namespace vellus {

void contract_failed(std::string_view what) {
    log_line(LogLevel::kError, what);
    std::abort();
}

}  // namespace vellus
