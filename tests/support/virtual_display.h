#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace vellus::test {

/// An X server of its own (Xvfb) that DISPLAY points to while this lives; its screen can be read.
class VirtualDisplay {
  public:
    /// Null where Xvfb is not installed or does not start.
    static std::unique_ptr<VirtualDisplay> start() {
        std::unique_ptr<VirtualDisplay> display(new VirtualDisplay);
        return display->launch() ? std::move(display) : nullptr;
    }
    ~VirtualDisplay() {
        if (server_ > 0) {
            ::kill(server_, SIGTERM);
            ::waitpid(server_, nullptr, 0);
        }
        std::error_code code;
        std::filesystem::remove_all(folder_, code);
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }

    /// 0xRRGGBB of one pixel of the screen.
    [[nodiscard]] uint32_t pixel(uint32_t x, uint32_t y) const {
        const std::vector<unsigned char> dump = read_screen();
        const auto word = [&](size_t index) {
            return uint32_t{dump[4 * index]} << 24U | uint32_t{dump[4 * index + 1]} << 16U |
                   uint32_t{dump[4 * index + 2]} << 8U | uint32_t{dump[4 * index + 3]};
        };
        // XWD header, big-endian words: 0 header size, 12 bytes per line, 19 colours of 12 bytes.
        const size_t pixels = word(0) + word(19) * 12;
        const size_t at = pixels + size_t{y} * word(12) + size_t{x} * 4;
        return uint32_t{dump[at + 2]} << 16U | uint32_t{dump[at + 1]} << 8U | uint32_t{dump[at]};
    }

  private:
    VirtualDisplay() = default;

    bool launch() {
        std::string folder = (std::filesystem::temp_directory_path() / "vellus_x_XXXXXX").string();
        if (!::mkdtemp(folder.data())) return false;
        folder_ = folder;
        std::array<int, 2> ready{};
        if (::pipe(ready.data()) != 0) return false;
        server_ = ::fork();
        if (server_ == 0) run_server(ready[1]);
        ::close(ready[1]);
        // The server writes its display's number and a line break once it accepts clients.
        std::string number;
        for (char c = 0; ::read(ready[0], &c, 1) == 1 && c != '\n';) number += c;
        ::close(ready[0]);
        if (number.empty()) return false;
        name_ = ":" + number;
        ::setenv("DISPLAY", name_.c_str(), 1);
        return true;
    }

    [[noreturn]] void run_server(int ready) const {
        ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // a test that crashes leaves no server behind
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
        const std::string descriptor = std::to_string(ready);
        ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1280x1024x24",
                 "-fbdir", folder_.c_str(), "-nolisten", "tcp", nullptr);
        ::_exit(127);
    }

    [[nodiscard]] std::vector<unsigned char> read_screen() const {
        std::ifstream file(folder_ / "Xvfb_screen0", std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

    pid_t server_ = -1;
    std::string name_;
    std::filesystem::path folder_;
};

}  // namespace vellus::test
