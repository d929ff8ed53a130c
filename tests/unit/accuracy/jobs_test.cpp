#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "game_demo/src/accuracy/table.h"
#include "game_demo/tools/accuracy/jobs.h"
#include "modules/hair/techniques.h"

namespace vellus::demo {
namespace {

std::vector<std::string> ids(const std::vector<Job>& jobs) {
    std::vector<std::string> result;
    result.reserve(jobs.size());
    for (const Job& job : jobs) result.push_back(job.id());
    return result;
}

TEST(AccuracyJobs, EveryTechniqueOfEveryAxisInEveryGroomAndColour) {
    const auto jobs = all_jobs({});
    std::set<std::string> grooms;
    std::set<std::string> colours;
    std::set<std::string> lights;
    for (const Job& job : jobs) {
        grooms.insert(job.subject.groom);
        colours.insert(job.subject.colour);
        lights.insert(job.subject.light);
    }
    EXPECT_EQ(grooms.size(), kGrooms.size());
    EXPECT_EQ(colours.size(), kColours.size());
    EXPECT_EQ(lights.size(), kLights.size());
    for (const std::string_view axis : hair::axes()) {
        for (const std::string_view technique : hair::technique_ids(axis)) {
            EXPECT_TRUE(std::ranges::any_of(
                jobs,
                [&](const Job& job) { return job.axis == axis && job.technique == technique; }))
                << axis << ' ' << technique;
        }
    }
}

TEST(AccuracyJobs, SettingsAreMeasuredInOneColourOnly) {
    std::map<std::string, std::set<std::string>> colours;  // of axis technique setting
    for (const Job& job : all_jobs({})) {
        colours[job.axis + ' ' + job.technique + ' ' + job.setting].insert(job.subject.colour);
    }
    EXPECT_EQ(colours.at("scattering karis "),
              (std::set<std::string>{kColours.begin(), kColours.end()}));
    EXPECT_EQ(colours.at("scattering karis roughness=0.2"), std::set<std::string>{"brown"});
    EXPECT_EQ(colours.at("multiple dual map=256"), std::set<std::string>{"brown"});
    EXPECT_EQ(colours.at("opacity dither taa=off"), std::set<std::string>{"white"});
    EXPECT_EQ(colours.at("frame shadow=deep_opacity map=256").size(), kColours.size());
}

TEST(AccuracyJobs, NamesAreUniqueAndFitForFiles) {
    const auto names = ids(all_jobs({}));
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const std::string& name : names) {
        EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.-"),
                  std::string::npos)
            << name;
    }
    EXPECT_EQ(names, ids(all_jobs({}))) << "the same list each time";
}

TEST(AccuracyJobs, ShardsTogetherAreTheWholeAndShareNoReference) {
    const auto jobs = all_jobs({});
    for (const uint32_t count : {1u, 2u, 5u, 7u, 500u}) {
        std::multiset<std::string> together;
        std::map<Subject, uint32_t> shard_of;
        for (uint32_t index = 0; index < count; ++index) {
            for (const Job& job : jobs_of_shard(jobs, {index, count})) {
                together.insert(job.id());
                EXPECT_EQ(shard_of.try_emplace(job.subject, index).first->second, index);
            }
        }
        const auto whole = ids(jobs);
        EXPECT_EQ(together, std::multiset<std::string>(whole.begin(), whole.end())) << count;
    }
}

TEST(AccuracyJobs, FiltersLeaveWhatTheyName) {
    AccuracyOptions options;
    options.axes = {"shadow"};
    options.grooms = {"fur"};
    options.lights = {"back"};
    options.techniques = {"none"};
    EXPECT_EQ(ids(all_jobs(options)), std::vector<std::string>{"shadow-none-fur-brown-back"});
}

TEST(AccuracyJobs, TheCommandLine) {
    const auto parse = [](std::vector<const char*> arguments) {
        arguments.insert(arguments.begin(), "vellus_accuracy");
        std::ostringstream out;
        return parse_accuracy_options(static_cast<int>(arguments.size()), arguments.data(), out,
                                      out);
    };
    const auto good = parse({"--quick", "--shard", "2/5", "--axes", "shadow,opacity", "--budget",
                             "16.6", "--seed", "9"});
    ASSERT_FALSE(good.exit_status);
    EXPECT_EQ(good.options.shard.index, 2u);
    EXPECT_EQ(good.options.shard.count, 5u);
    EXPECT_EQ(good.options.axes, (std::vector<std::string>{"shadow", "opacity"}));
    EXPECT_EQ(good.options.budget_ms, 16.6);
    EXPECT_EQ(job_sizes(good.options).seed, 9u);
    for (const auto& bad : std::vector<std::vector<const char*>>{{"--shard", "5/5"},
                                                                 {"--shard", "1"},
                                                                 {"--shard", "a/b"},
                                                                 {"--axes", "colour"},
                                                                 {"--grooms", "bald"},
                                                                 {"--size", "0"},
                                                                 {"--budget", "-1"}}) {
        EXPECT_EQ(parse(bad).exit_status, 2) << bad[1];
    }
    EXPECT_EQ(parse({"--help"}).exit_status, 0);
}

}  // namespace
}  // namespace vellus::demo
