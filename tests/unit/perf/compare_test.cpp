#include "tests/perf/report/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/platform/files.h"
#include "tests/support/own_folder.h"

namespace vellus::bench {
namespace {

/// A run on a machine `speed` times as fast, with a few percent of noise from `seed`.
Report run(double speed, uint64_t seed, double shade_ms = 20.0, double bytes = 1e6) {
    std::mt19937_64 random(seed);
    const auto samples = [&](double mean) {
        std::normal_distribution<double> noise(mean / speed, 0.04 * mean / speed);
        std::vector<double> times(64);
        for (double& time : times) time = noise(random);
        return times;
    };
    Report report{.device = "test", .command = "test"};
    report.calibration = make_row("calibration", "ms", samples(15.0));
    report.rows = {make_row("walk/wall", "ms", samples(60.0)),
                   make_row("walk/hair/shade", "ms", samples(shade_ms)),
                   make_row("walk/tiny", "ms", samples(0.01)),
                   make_row("walk/memory", "bytes", {bytes})};
    report.hashes["walk"] = "0123";
    return report;
}

const Comparison& row(const std::vector<Comparison>& rows, const std::string& name) {
    return *std::ranges::find(rows, name, &Comparison::name);
}

TEST(Compare, TheNoiseOfAMedianIsWhatManyRunsShow) {
    // The notch half width is 1.57 IQR / sqrt(n) = 2.12 sigma / sqrt(n); a median's own deviation
    // is 1.25 sigma / sqrt(n).
    double squares = 0.0;
    double noise = 0.0;
    constexpr int kRuns = 400;
    for (uint64_t seed = 0; seed < kRuns; ++seed) {
        const Row shade = run(1.0, seed).rows[1];
        squares += (shade.median - 20.0) * (shade.median - 20.0);
        noise += shade.noise;
    }
    const double deviation = std::sqrt(squares / kRuns);
    EXPECT_NEAR(noise / kRuns / deviation, 2.12 / 1.25, 0.25);
}

TEST(Compare, ARerunOnAnyMachineIsTheSame) {
    int wrong = 0;
    for (uint64_t seed = 0; seed < 100; ++seed) {
        const auto rows = compare(run(1.0, 2 * seed), run(seed % 2 ? 3.0 : 0.4, 2 * seed + 1));
        wrong += any_worse(rows) ? 1 : 0;
        EXPECT_EQ(row(rows, "walk/memory").change, Change::kSame);
    }
    EXPECT_EQ(wrong, 0);
}

TEST(Compare, ASlowdownIsCaughtOnAFasterMachineToo) {
    for (uint64_t seed = 0; seed < 100; ++seed) {
        const auto rows = compare(run(1.0, 2 * seed), run(2.0, 2 * seed + 1, 23.0));
        EXPECT_EQ(row(rows, "walk/hair/shade").change, Change::kWorse) << seed;
        EXPECT_EQ(row(rows, "walk/wall").change, Change::kSame) << seed;
        EXPECT_TRUE(any_worse(rows));
        EXPECT_EQ(row(compare(run(1.0, seed), run(2.0, seed + 1, 17.0)), "walk/hair/shade").change,
                  Change::kBetter);
    }
}

TEST(Compare, BytesAreComparedAsTheyAre) {
    EXPECT_TRUE(any_worse(compare(run(1.0, 1), run(1.0, 1, 20.0, 1.01e6))));
    EXPECT_FALSE(any_worse(compare(run(1.0, 1), run(1.0, 1, 20.0, 1.001e6))));
}

TEST(Compare, RowsThatComeAndGoAreNamed) {
    Report before = run(1.0, 1);
    Report after = run(1.0, 1);
    before.rows.erase(before.rows.begin());
    after.rows.pop_back();
    const auto rows = compare(before, after);
    EXPECT_EQ(row(rows, "walk/wall").change, Change::kNew);
    EXPECT_EQ(row(rows, "walk/memory").change, Change::kGone);
    EXPECT_FALSE(any_worse(rows));
}

TEST(ReportFile, ReadsBackWhatWasWritten) {
    const test::OwnFolder own("report");
    const Report report = run(1.0, 5);
    ASSERT_TRUE(write_file(own.path() / "a.json", std::string_view(to_json(report))));
    const auto read = load_report(own.path() / "a.json");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(to_json(*read), to_json(report));
}

TEST(ReportFile, RefusesWhatIsNone) {
    const test::OwnFolder own("report");
    const auto file = own.path() / "a.json";
    const std::string good = to_json(run(1.0, 5));
    std::string renamed = good;
    renamed.replace(renamed.find("\"median\""), 8, "\"medium\"");
    for (const std::string& text : {std::string(), std::string("{}"), std::string("[1]"),
                                    good.substr(0, good.size() / 2), renamed}) {
        ASSERT_TRUE(write_file(file, std::string_view(text)));
        const auto read = load_report(file);
        ASSERT_FALSE(read) << text.substr(0, 40);
        EXPECT_NE(read.error().message().find("a.json"), std::string::npos);
    }
}

}  // namespace
}  // namespace vellus::bench
