#include "engine/platform/log.h"

#include <cstdio>
#include <mutex>
#include <utility>

namespace vellus {

namespace {

void write_to_stderr(LogLevel level, std::string_view line) {
    const char* prefix = level == LogLevel::kInfo      ? ""
                         : level == LogLevel::kWarning ? "warning: "
                                                       : "error: ";
    std::fprintf(stderr, "%s%.*s\n", prefix, static_cast<int>(line.size()), line.data());
}

std::mutex sink_mutex;

LogSink& current_sink() {
    static LogSink sink = write_to_stderr;
    return sink;
}

}  // namespace

LogSink set_log_sink(LogSink sink) {
    const std::lock_guard lock(sink_mutex);
    return std::exchange(current_sink(), sink ? std::move(sink) : LogSink(write_to_stderr));
}

void log_line(LogLevel level, std::string_view line) {
    const std::lock_guard lock(sink_mutex);
    current_sink()(level, line);
}

}  // namespace vellus
