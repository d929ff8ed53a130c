#include <gtest/gtest.h>

#include "engine/platform/files.h"
#include "game_demo/src/accuracy/table.h"
#include "tests/end_to_end/small_groom.h"
#include "tests/support/own_folder.h"
#include "tests/support/process.h"

namespace vellus::demo {
namespace {

namespace fs = std::filesystem;

/// vellus_accuracy at its smallest: two techniques of shadow and two frames, on two grooms.
class AccuracyTest : public testing::Test {
  protected:
    test::Ended measure(const fs::path& out, std::vector<std::string> more) {
        std::vector<std::string> command = {VELLUS_ACCURACY,
                                            "--out",
                                            out,
                                            "--quick",
                                            "--size",
                                            "32",
                                            "--frames",
                                            "2",
                                            "--spp",
                                            "2",
                                            "--strands",
                                            "200",
                                            "--axes",
                                            "shadow,frame",
                                            "--colours",
                                            "brown",
                                            "--lights",
                                            "front,outdoors",
                                            "--techniques",
                                            "none,pcf_exponential,base,shadow=none"};
        command.insert(command.end(), more.begin(), more.end());
        return test::run(command);
    }
    [[nodiscard]] fs::path folder(const char* name) const { return own_.path() / name; }

    static std::vector<std::string> ids(const fs::path& out) {
        const auto table = load_accuracy(out / "accuracy.json");
        EXPECT_TRUE(table) << table.error().message();
        std::vector<std::string> result;
        for (const AccuracyRow& row : table->rows) result.push_back(row.id);
        return result;
    }

    test::OwnFolder own_{"accuracy_run"};
};

TEST_F(AccuracyTest, DoesNothingTwiceAndPartsMakeTheWhole) {
    const auto first = measure(folder("whole"), {});
    ASSERT_EQ(first.status, 0) << first.output;
    const auto whole = ids(folder("whole"));
    // Two grooms: none, pcf_exponential, the base frame, and those with either.
    EXPECT_EQ(whole.size(), 8u);
    const fs::path file = folder("whole") / "jobs" / (whole[0] + ".json");
    const auto written = fs::last_write_time(file);
    const auto again = measure(folder("whole"), {});
    EXPECT_EQ(again.status, 0);
    EXPECT_NE(again.output.find("8 of 8 jobs are done already"), std::string::npos) << again.output;
    EXPECT_EQ(fs::last_write_time(file), written);

    // What another build measured is measured again.
    const auto bytes = read_file(file);
    ASSERT_TRUE(bytes);
    std::string row(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    const size_t program = row.find(" program ");
    ASSERT_NE(program, std::string::npos);
    row.replace(program + 9, 8, "not this");
    ASSERT_TRUE(write_file(file, std::string_view(row)));
    const auto rebuilt = measure(folder("whole"), {});
    EXPECT_NE(rebuilt.output.find("7 of 8 jobs are done already"), std::string::npos)
        << rebuilt.output;

    ASSERT_EQ(measure(folder("part0"), {"--shard", "0/2"}).status, 0);
    ASSERT_EQ(measure(folder("part1"), {"--shard", "1/2"}).status, 0);
    const auto merged = test::run(
        {VELLUS_ACCURACY, "--out", folder("all"), "--merge", folder("part0"), folder("part1")});
    ASSERT_EQ(merged.status, 0) << merged.output;
    EXPECT_EQ(ids(folder("all")), whole);
    EXPECT_LT(ids(folder("part0")).size(), whole.size());
}

TEST_F(AccuracyTest, TheBudgetIsSpentAndTheDemoTakesTheTable) {
    const auto spent = measure(folder("out"), {"--grooms", "straight", "--budget", "10000"});
    ASSERT_EQ(spent.status, 0) << spent.output;
    EXPECT_NE(spent.output.find("predicted"), std::string::npos) << spent.output;
    EXPECT_NE(spent.output.find("measured"), std::string::npos) << spent.output;

    const fs::path groom = test::write_small_groom(own_.path());
    const auto demo = test::run({VELLUS_DEMO, groom, "--headless", "--frames", "1", "--size",
                                 "48x32", "--out", folder("demo"), "--validation", "--budget",
                                 "100000", "--accuracy", folder("out") / "frames.json"});
    EXPECT_EQ(demo.status, 0) << demo.output;
    EXPECT_NE(demo.output.find("shadow="), std::string::npos) << demo.output;
    const auto missing = test::run(
        {VELLUS_DEMO, groom, "--headless", "--budget", "5", "--accuracy", "no_such.json"});
    EXPECT_EQ(missing.status, 2);
    EXPECT_NE(missing.output.find("no_such.json"), std::string::npos) << missing.output;
}

}  // namespace
}  // namespace vellus::demo
