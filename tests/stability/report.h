#pragma once

#include <limits>
#include <string>
#include <utility>

namespace vellus::test {

/// One line of the table that `ctest -L stability` prints at its end.
struct StabilityRow {
    std::string area;
    std::string test;
    std::string worst_input;
    double error = 0.0;
    double bound = 0.0;
};

/// Adds the row to the table and fails the running test where error > bound or is not a number.
void report_row(const StabilityRow& row);

/// Keeps the largest error seen and what caused it.
class Worst {
  public:
    /// `describe` is called only for a new worst; NaN counts as infinite.
    template <class Describe>
    void add(double error, const Describe& describe) {
        if (error <= error_) return;
        error_ = error == error ? error : std::numeric_limits<double>::infinity();
        input_ = describe();
    }
    void report(std::string area, std::string test, double bound) const {
        report_row({std::move(area), std::move(test), input_, error_ < 0.0 ? 0.0 : error_, bound});
    }

  private:
    double error_ = -1.0;
    std::string input_ = "-";
};

}  // namespace vellus::test
