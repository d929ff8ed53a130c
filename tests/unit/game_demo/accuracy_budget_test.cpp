#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/platform/files.h"
#include "game_demo/src/accuracy/budget.h"
#include "tests/support/own_folder.h"

namespace vellus::demo {
namespace {

AccuracyRow frame(const std::string& technique, const std::string& setting, double ms, double error,
                  double bias, const std::string& groom = "curly",
                  const std::string& colour = "brown") {
    AccuracyRow row;
    row.id = technique + setting + groom + colour;
    row.axis = kFrameAxis;
    row.technique = technique;
    row.setting = setting;
    row.groom = groom;
    row.colour = colour;
    row.error = error;
    row.measures["bias"] = bias;
    row.frame_ms = {ms, ms - 1, ms + 1};
    return row;
}

/// The base: 20 ms and 50 % too bright; cheaper and worse, dearer and better.
AccuracyTable table() {
    AccuracyTable all;
    all.rows = {frame(kBase, "", 20, 0.50, 0.50),
                frame("shadow=none", "", 12, 0.90, 0.50),
                frame("multiple=fake_normal", "", 23, 0.20, 0.12),
                frame("multiple=none", "", 19, 0.35, -0.35),
                frame("environment=none", "", 18, 0.33, -0.10),
                frame("opacity=dither", "detail=0.5", 15, 0.55, 0.50),
                frame(kBase, "", 40, 0.10, 0.0, "fur", "white")};
    return all;
}

bool chose(const Combination& combination, const AxisChoice& choice) {
    return std::ranges::find(combination.choices, choice) != combination.choices.end();
}

TEST(AccuracyBudget, OneChoiceIsPredictedAsItWasMeasured) {
    const FrameModel model = frame_model(table(), "curly", "brown");
    EXPECT_DOUBLE_EQ(predict(model, {}).ms, 20);
    EXPECT_DOUBLE_EQ(predict(model, {}).error, 0.5);
    EXPECT_EQ(model.effects.size(), 5u);
    for (const AccuracyRow& row : table().rows) {
        const size_t equals = row.technique.find('=');
        if (equals == std::string::npos) continue;
        const Combination one = predict(model, {{row.technique.substr(0, equals),
                                                 row.technique.substr(equals + 1), row.setting}});
        EXPECT_NEAR(one.ms, row.frame_ms.median, 1e-12) << row.technique;
        EXPECT_NEAR(one.error, row.error, 1e-12) << row.technique;
    }
}

// Light missing twice is missing twice, even where either lack alone hides that all is too bright.
TEST(AccuracyBudget, BiasesAddUpWithTheirSign) {
    const FrameModel model = frame_model(table(), "curly", "brown");
    const Combination dark =
        predict(model, {{"multiple", "none", ""}, {"environment", "none", ""}});
    EXPECT_NEAR(dark.ms, 20 - 1 - 2, 1e-12);
    // .5 - .85 - .6 = -.95; of environment=none there is .33² - .1² besides.
    EXPECT_NEAR(dark.error, std::sqrt(0.95 * 0.95 + 0.0989), 1e-12);
}

TEST(AccuracyBudget, WhatIsTooBrightDoesNotHideWhatIsTooDark) {
    AccuracyTable all;
    all.rows = {frame(kBase, "", 20, 0.1, 0.0), frame("multiple=fake_normal", "", 19, 0.5, 0.4),
                frame("environment=none", "", 18, 0.4, -0.3)};
    const FrameModel model = frame_model(all, "curly", "brown");
    const Combination both =
        predict(model, {{"multiple", "fake_normal", ""}, {"environment", "none", ""}});
    // As a whole .1 too bright. Beside that each has its own rest (.09 and .07, of which the base's
    // .01 counts once), and .3 of light is in the wrong places.
    EXPECT_NEAR(both.error, std::sqrt(0.1 * 0.1 + 0.09 + 0.07 - 0.01 + 0.3 * 0.3), 1e-12);
    EXPECT_GT(both.error, predict(model, {{"environment", "none", ""}}).error);
}

TEST(AccuracyBudget, TimesAreMediansOverColoursAndTheirSharesOverAllPictures) {
    AccuracyTable all;
    const char* colours[] = {"black", "brown", "blond"};
    const double base[] = {20, 90, 22};  // something else ran during one
    for (int i = 0; i < 3; ++i) {
        all.rows.push_back(frame(kBase, "", base[i], 0.5, 0.0, "curly", colours[i]));
        all.rows.push_back(frame("shadow=none", "", 10 + i, 0.6, 0.0, "curly", colours[i]));
        all.rows.push_back(frame(kBase, "", 1, 0.5, 0.0, "fur", colours[i]));
    }
    const FrameModel model = frame_model(all, "curly", "brown");
    EXPECT_DOUBLE_EQ(model.base.ms, 22);
    EXPECT_DOUBLE_EQ(predict(model, {{"shadow", "none", ""}}).ms, 11);
}

TEST(AccuracyBudget, PicksTheLeastErrorThatFits) {
    const FrameModel model = frame_model(table(), "curly", "brown");
    const auto roomy = best_within(model, 100);
    ASSERT_TRUE(roomy);
    EXPECT_TRUE(chose(*roomy, {"multiple", "fake_normal", ""}));
    EXPECT_NEAR(roomy->ms, 23, 1e-12);
    EXPECT_NEAR(roomy->error, 0.2, 1e-12);
    // 19 ms: fake_normal is still worth half the strands.
    const auto middle = best_within(model, 19);
    EXPECT_TRUE(chose(*middle, {"multiple", "fake_normal", ""}));
    EXPECT_TRUE(chose(*middle, {"opacity", "dither", "detail=0.5"}));
    EXPECT_LE(middle->ms, 19);
    const auto tight = best_within(model, 1);
    EXPECT_GT(tight->ms, 1) << "nothing fits: the cheapest";
    EXPECT_TRUE(chose(*tight, {"shadow", "none", ""}));
}

TEST(AccuracyBudget, AgreesWithTryingAll) {
    const FrameModel model = frame_model(table(), "curly", "brown");
    // 2 opacity x 2 shadow x 1 scattering x 3 multiple x 2 environment.
    ASSERT_EQ(combinations(model).size(), 24u);
    for (int half = 10; half < 50; ++half) {
        const double budget = 0.5 * half;
        const auto best = best_within(model, budget);
        ASSERT_TRUE(best);
        for (const Combination& each : combinations(model)) {
            if (best->ms > budget) {
                EXPECT_GE(each.ms, best->ms) << "none fits: the cheapest";
            } else if (each.ms <= budget) {
                EXPECT_GE(each.error, best->error);
            }
        }
    }
}

TEST(AccuracyBudget, WhatWasNotMeasuredTakesTheNearestThatWas) {
    EXPECT_DOUBLE_EQ(frame_model(table(), "fur", "black").base.ms, 40)
        << "another colour of the groom";
    EXPECT_DOUBLE_EQ(frame_model(table(), "wavy", "black").base.ms, 30) << "the mean of all";
    EXPECT_TRUE(frame_model({}, "wavy", "black").empty());
    EXPECT_FALSE(best_within({}, 10));
}

TEST(AccuracyTable, ReadsBackWhatItWrote) {
    const test::OwnFolder folder("accuracy_table");
    AccuracyTable written = table();
    written.device = "a \"device\" <b>";
    written.seed = 7;
    written.rows[1].measures = {{"l2", 0.25}, {"flip", 0.5}};
    written.rows[1].pictures = {"a.png", "b.png", "c.png"};
    written.rows[1].transient_bytes = 1ULL << 40U;
    ASSERT_TRUE(write_file(folder.path() / "t.json", std::string_view(to_json(written))));
    const auto read = load_accuracy(folder.path() / "t.json");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(to_json(*read), to_json(written));

    ASSERT_TRUE(write_file(folder.path() / "bad.json", std::string_view("{\"rows\": [{}]}")));
    const auto bad = load_accuracy(folder.path() / "bad.json");
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message().find("bad.json"), std::string::npos);
}

TEST(AccuracyTable, SpreadIsMedianAndDeciles) {
    std::vector<double> samples;
    for (int i = 100; i >= 0; --i) samples.push_back(i);
    const Spread spread = spread_of(samples);
    EXPECT_DOUBLE_EQ(spread.median, 50);
    EXPECT_DOUBLE_EQ(spread.low, 10);
    EXPECT_DOUBLE_EQ(spread.high, 90);
    EXPECT_DOUBLE_EQ(spread_of({}).median, 0);
    EXPECT_DOUBLE_EQ(spread_of({4}).high, 4);
}

}  // namespace
}  // namespace vellus::demo
