#include "tests/perf/report/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vellus::bench {

namespace {

constexpr double kBytesTolerance = 0.005;
constexpr double kNoises = 3.0;

double relative_noise(const Row& row) {
    return row.median > 0.0 ? row.noise / row.median : 0.0;
}

const Row* find(const std::vector<Row>& rows, const std::string& name) {
    const auto found = std::ranges::find(rows, name, &Row::name);
    return found == rows.end() ? nullptr : &*found;
}

Comparison compare_rows(const Row& before, const Row& after, const Report& run_before,
                        const Report& run_after, const Tolerances& tolerances) {
    Comparison result{.name = before.name,
                      .unit = before.unit,
                      .before = before.median,
                      .after = after.median,
                      .tolerance = kBytesTolerance};
    double scale = 1.0;
    if (before.unit == "ms") {
        const Row& speed_before = run_before.calibration;
        const Row& speed_after = run_after.calibration;
        if (speed_before.median > 0.0 && speed_after.median > 0.0) {
            scale = speed_before.median / speed_after.median;
        }
        const double noise =
            std::hypot(std::hypot(relative_noise(before), relative_noise(after)),
                       std::hypot(relative_noise(speed_before), relative_noise(speed_after)));
        result.tolerance = std::max(tolerances.least, kNoises * noise);
        if (std::max(before.median, after.median) < tolerances.least_ms) return result;
    }
    if (before.median == after.median) return result;
    result.ratio = before.median > 0.0 ? scale * after.median / before.median
                                       : std::numeric_limits<double>::infinity();
    if (result.ratio > 1.0 + result.tolerance) result.change = Change::kWorse;
    if (result.ratio < 1.0 - result.tolerance) result.change = Change::kBetter;
    return result;
}

}  // namespace

std::vector<Comparison> compare(const Report& before, const Report& after,
                                const Tolerances& tolerances) {
    std::vector<Comparison> results;
    for (const Row& row : before.rows) {
        if (const Row* now = find(after.rows, row.name)) {
            results.push_back(compare_rows(row, *now, before, after, tolerances));
        } else {
            results.push_back({.name = row.name,
                               .unit = row.unit,
                               .before = row.median,
                               .change = Change::kGone});
        }
    }
    for (const Row& row : after.rows) {
        if (find(before.rows, row.name) != nullptr) continue;
        results.push_back(
            {.name = row.name, .unit = row.unit, .after = row.median, .change = Change::kNew});
    }
    return results;
}

bool any_worse(const std::vector<Comparison>& comparisons) {
    return std::ranges::any_of(comparisons, [](const Comparison& comparison) {
        return comparison.change == Change::kWorse;
    });
}

}  // namespace vellus::bench
