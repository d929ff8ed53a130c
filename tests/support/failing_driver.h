#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <utility>

namespace vellus::test {

/// Puts another function in the place of one of volk's while it lives: what a driver answers on a
/// bad day.
template <class F>
class Replaced {
  public:
    Replaced(F& function, F other) : function_(function), kept_(std::exchange(function, other)) {}
    ~Replaced() { function_ = kept_; }
    Replaced(const Replaced&) = delete;
    Replaced& operator=(const Replaced&) = delete;

  private:
    F& function_;
    F kept_;
};

/// Lets the process have only so many bytes more than it has; a driver for the CPU then runs out of
/// device memory for real.
class MemoryLimit {
  public:
    explicit MemoryLimit(uint64_t bytes_more) {
        uint64_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        getrlimit(RLIMIT_AS, &kept_);
        rlimit limit = kept_;
        limit.rlim_cur = pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE)) + bytes_more;
        works_ = pages != 0 && setrlimit(RLIMIT_AS, &limit) == 0;
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &kept_); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

    /// False where sanitizers reserve memory in ways a limit breaks.
    [[nodiscard]] static bool possible() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        return false;
#else
        return true;
#endif
    }
    [[nodiscard]] bool works() const {
        return works_;
    }

  private:
    rlimit kept_{};
    bool works_ = false;
};

}  // namespace vellus::test
