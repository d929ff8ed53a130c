#pragma once

#include <gtest/gtest.h>

#include <filesystem>

/// Names a file of the shared test data, or skips the test where it is absent.
// NOLINTNEXTLINE(bugprone-macro-parentheses): `variable` is declared.
#define VELLUS_ASSET_FILE(variable, relative)                                                    \
    const std::filesystem::path variable = std::filesystem::path(VELLUS_TEST_DATA) / (relative); \
    if (!std::filesystem::exists(variable)) {                                                    \
        GTEST_SKIP() << variable << " is not here";                                              \
    }
