#include "engine/platform/clock.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "engine/platform/user_folders.h"

namespace vellus {
namespace {

void burn(double cpu_seconds) {
    timespec now{};
    const auto used = [&] {
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    };
    const double start = used();
    while (used() - start < cpu_seconds) {
    }
}

TEST(Clock, ProcessTimeAddsUpAllThreads) {
    const double wall = wall_seconds();
    const double cpu = process_cpu_seconds();
    std::vector<std::jthread> threads;
    threads.reserve(3);
    for (int i = 0; i < 3; ++i) threads.emplace_back(burn, 0.02);
    threads.clear();
    EXPECT_GE(process_cpu_seconds() - cpu, 0.06);
    // However few cores there were, the wall clock saw at least the longest thread.
    EXPECT_GE(wall_seconds() - wall, 0.02);
}

TEST(UserFolders, XdgWinsOverHomeAndRelativePathsAreIgnored) {
    ::setenv("HOME", "/home/someone", 1);
    ::setenv("XDG_CACHE_HOME", "/var/cache/me", 1);
    EXPECT_EQ(cache_folder(), "/var/cache/me/vellus");
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    EXPECT_EQ(cache_folder(), "/home/someone/.cache/vellus");
    ::unsetenv("XDG_CACHE_HOME");
    ::unsetenv("HOME");
    EXPECT_TRUE(cache_folder().empty());
}

}  // namespace
}  // namespace vellus
