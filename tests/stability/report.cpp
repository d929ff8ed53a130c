#include "tests/stability/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

namespace vellus::test {

namespace {

std::vector<StabilityRow>& rows() {
    static std::vector<StabilityRow> all;
    return all;
}

/// Prints the table after the last test.
class TablePrinter : public testing::Environment {
  public:
    void TearDown() override {
        fmt::print("{:<12} {:<34} {:>10} {:>10}  {}\n", "area", "case", "error", "bound",
                   "worst input");
        for (const StabilityRow& row : rows()) {
            fmt::print("{:<12} {:<34} {:>10.2e} {:>10.2e}  {}\n", row.area, row.test, row.error,
                       row.bound, row.worst_input);
        }
    }
};

[[maybe_unused]] const auto* const kPrinter = testing::AddGlobalTestEnvironment(new TablePrinter);

}  // namespace

void report_row(StabilityRow row) {
    EXPECT_LE(row.error, row.bound) << row.area << ": " << row.test << " at " << row.worst_input;
    rows().push_back(std::move(row));
}

}  // namespace vellus::test
