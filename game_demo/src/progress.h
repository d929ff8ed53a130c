#pragma once

#include <cstdint>

namespace vellus::demo {

/// A bar on stderr that says how far a long run is; a line a minute where stderr is no terminal.
class Progress {
  public:
    /// `unit`: what is counted; `first` of them were done before.
    explicit Progress(uint32_t total, const char* unit = "frames", uint32_t first = 0);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(uint32_t done);

  private:
    uint32_t total_;
    const char* unit_;
    uint32_t first_;
    double start_;
    double said_;  ///< when the last line was
    bool visible_;
};

}  // namespace vellus::demo
