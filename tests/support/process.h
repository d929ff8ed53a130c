#pragma once

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace vellus::test {

/// A program with its stdout and stderr in one pipe; killed if still running at the end.
class Process {
  public:
    explicit Process(std::vector<std::string> arguments) {
        std::array<int, 2> pipe{};
        if (::pipe(pipe.data()) != 0) return;
        child_ = ::fork();
        if (child_ == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);
            ::dup2(pipe[1], STDOUT_FILENO);
            ::dup2(pipe[1], STDERR_FILENO);
            ::close(pipe[0]);
            ::close(pipe[1]);
            std::vector<char*> pointers;
            pointers.reserve(arguments.size() + 1);
            for (std::string& argument : arguments) pointers.push_back(argument.data());
            pointers.push_back(nullptr);
            ::execvp(pointers[0], pointers.data());
            ::_exit(127);
        }
        ::close(pipe[1]);
        pipe_ = pipe[0];
    }
    ~Process() {
        if (running_) {
            ::kill(child_, SIGKILL);
            ::waitpid(child_, nullptr, 0);
        }
        ::close(pipe_);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Reads until the output holds `text`; false where the program ends or five minutes pass in
    /// silence.
    bool wait_for(const std::string& text) {
        while (output_.find(text) == std::string::npos) {
            if (!read_some()) return false;
        }
        return true;
    }
    /// The exit status, after all output; -1 after a signal or five minutes of silence.
    int wait() {
        while (read_some()) {
        }
        if (timed_out_) return -1;
        int status = 0;
        ::waitpid(child_, &status, 0);
        running_ = false;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /// As Ctrl-C does.
    void interrupt() const { ::kill(child_, SIGINT); }
    [[nodiscard]] const std::string& output() const { return output_; }

  private:
    bool read_some() {
        constexpr int kSilenceMs = 300'000;
        pollfd waiting{.fd = pipe_, .events = POLLIN, .revents = 0};
        timed_out_ = ::poll(&waiting, 1, kSilenceMs) == 0;
        if (timed_out_) return false;
        std::array<char, 4096> bytes{};
        const ssize_t count = ::read(pipe_, bytes.data(), bytes.size());
        if (count <= 0) return false;
        output_.append(bytes.data(), static_cast<size_t>(count));
        return true;
    }

    pid_t child_ = -1;
    int pipe_ = -1;
    bool running_ = true;
    bool timed_out_ = false;
    std::string output_;
};

/// Runs a program to its end.
struct Ended {
    int status = -1;
    std::string output;
};
inline Ended run(std::vector<std::string> arguments) {
    Process process(std::move(arguments));
    const int status = process.wait();
    return {status, process.output()};
}

}  // namespace vellus::test
