#include "tests/stability/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/platform/files.h"

namespace vellus::test {

namespace {

namespace fs = std::filesystem;

/// Prints the rows of each test at its end, and leaves them where print_table looks for them:
/// ctest runs each test in a process of its own.
class RowKeeper : public testing::EmptyTestEventListener {
  public:
    void add(const StabilityRow& row) {
        rows_ += fmt::format("{:<14} {:<40} {:>10.2e} {:>10.2e}  {}\n", row.area, row.test,
                             row.error, row.bound, row.worst_input);
    }

  private:
    void OnTestEnd(const testing::TestInfo& test) override {
        if (rows_.empty()) return;
        fmt::print("{}", rows_);
        const fs::path folder = fs::path(VELLUS_BINARY_DIR) / "tests/stability/rows";
        std::error_code code;
        fs::create_directories(folder, code);
        const auto name = fmt::format("{}.{}.txt", test.test_suite_name(), test.name());
        const auto kept = write_file(folder / name, std::string_view(rows_));
        if (!kept) fmt::print(stderr, "{}\n", kept.error().message());
        rows_.clear();
    }

    std::string rows_;
};

RowKeeper& keeper() {
    static auto* const listener = [] {
        auto* made = new RowKeeper;  // gtest owns it
        testing::UnitTest::GetInstance()->listeners().Append(made);
        return made;
    }();
    return *listener;
}

}  // namespace

void report_row(const StabilityRow& row) {
    EXPECT_LE(row.error, row.bound) << row.area << ": " << row.test << " at " << row.worst_input;
    keeper().add(row);
}

}  // namespace vellus::test
