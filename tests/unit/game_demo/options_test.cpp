#include "game_demo/src/options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace vellus::demo {
namespace {

struct Parsed {
    Options options;
    std::optional<int> status;
    std::string out;
    std::string err;
};

Parsed parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "vellus_demo");
    std::ostringstream out;
    std::ostringstream err;
    auto parsed = parse_options(static_cast<int>(arguments.size()), arguments.data(), out, err);
    return {std::move(parsed.options), parsed.exit_status, out.str(), err.str()};
}

TEST(Options, TheWholeHeadlessContract) {
    const auto parsed = parse({"scene.gltf",     "--headless",
                               "--frames",       "40",
                               "--size",         "64x48",
                               "--out",          "dir",
                               "--save",         "3,1",
                               "--dt",           "0.25",
                               "--seed",         "9",
                               "--device",       "llvm",
                               "--set",          "shadow=none",
                               "--set",          "opacity=dither_still",
                               "--graph-switch", "random_order=5",
                               "--graph-switch", "poison",
                               "--validation",   "--explain",
                               "--warmup",       "2"});
    ASSERT_FALSE(parsed.status) << parsed.err;
    const Options& options = parsed.options;
    EXPECT_EQ(options.scene, "scene.gltf");
    EXPECT_TRUE(options.headless && options.validation && options.explain);
    EXPECT_EQ(options.frames, 40u);
    EXPECT_EQ(options.warmup, 2u);
    EXPECT_EQ(options.size, (std::array<uint32_t, 2>{64, 48}));
    EXPECT_EQ(options.out, "dir");
    EXPECT_EQ(options.save.frames, (std::vector<uint32_t>{1, 3}));
    EXPECT_EQ(options.dt, 0.25);
    EXPECT_EQ(options.seed, 9u);
    EXPECT_EQ(options.device, "llvm");
    ASSERT_EQ(options.techniques.size(), 2u);
    EXPECT_EQ(options.techniques[0].axis, "shadow");
    EXPECT_EQ(options.techniques[1].technique, "dither_still");
    EXPECT_TRUE(options.switches.random_order && options.switches.poison);
    EXPECT_EQ(options.switches.seed, 5u);
    EXPECT_FALSE(options.switches.immediate);
}

TEST(Options, TheSceneMayStandAfterTheTechniques) {
    const auto parsed = parse({"--set", "shadow=none", "groom.hair"});
    ASSERT_FALSE(parsed.status) << parsed.err;
    EXPECT_EQ(parsed.options.scene, "groom.hair");
    EXPECT_EQ(parsed.options.techniques.size(), 1u);
}

TEST(Options, TheLastOfTwoCounts) {
    const auto parsed = parse({"--size", "1x1", "--seed", "1", "--size=20x10", "--seed", "2"});
    ASSERT_FALSE(parsed.status) << parsed.err;
    EXPECT_EQ(parsed.options.size, (std::array<uint32_t, 2>{20, 10}));
    EXPECT_EQ(parsed.options.seed, 2u);
}

TEST(Options, HeadlessEndsEvenIfNotTold) {
    EXPECT_EQ(parse({}).options.frames, 0u);
    EXPECT_GT(parse({"--headless"}).options.frames, 0u);
}

TEST(Options, HelpNamesEveryOption) {
    const auto parsed = parse({"--help"});
    EXPECT_EQ(parsed.status, 0);
    for (const char* option :
         {"--headless", "--frames", "--size", "--out", "--save", "--dt", "--seed", "--device",
          "--set", "--graph-switch", "--validation", "--explain", "--list-devices", "--warmup",
          "pcf_exponential", "no_aliasing"}) {
        EXPECT_NE(parsed.out.find(option), std::string::npos) << option;
    }
}

struct Mistake {
    std::vector<const char*> arguments;
    std::vector<const char*> named;
};

TEST(Options, MistakesNameTheOptionAndWhatItMayBe) {
    const Mistake mistakes[] = {
        {{"--size", "1280"}, {"--size", "1280", "WIDTHxHEIGHT"}},
        {{"--size", "0x10"}, {"--size", "0x10"}},
        {{"--size", "10x20000"}, {"--size", "16384"}},
        {{"--size", "10x20x30"}, {"--size"}},
        {{"--frames", "0"}, {"--frames", "1"}},
        {{"--frames", "many"}, {"--frames", "many"}},
        {{"--frames", "-3"}, {"--frames"}},
        {{"--save", "some"}, {"--save", "some", "all", "last"}},
        {{"--save", "1,,2"}, {"--save"}},
        {{"--headless", "--frames", "4", "--save", "4"}, {"--save", "4", "0 to 3"}},
        {{"--dt", "-1"}, {"--dt"}},
        {{"--dt", "nan"}, {"--dt"}},
        {{"--seed", "x"}, {"--seed"}},
        {{"--set", "shadow"}, {"--set", "shadow", "AXIS=TECHNIQUE"}},
        {{"--set", "shadow=exact"}, {"--set", "exact", "pcf_exponential"}},
        {{"--set", "colour=red"}, {"--set", "colour", "opacity"}},
        {{"--graph-switch", "fast"}, {"--graph-switch", "fast", "no_culling"}},
        {{"--graph-switch", "poison=1"}, {"--graph-switch", "poison=1"}},
        {{"--graph-switch", "random_order=x"}, {"--graph-switch", "random_order=7"}},
        {{"--nonsense"}, {"--nonsense"}},
        {{"a.gltf", "b.gltf"}, {"b.gltf"}},
    };
    for (const Mistake& mistake : mistakes) {
        const auto parsed = parse(mistake.arguments);
        EXPECT_EQ(parsed.status, 2) << mistake.arguments[0];
        EXPECT_EQ(std::ranges::count(parsed.err, '\n'), 1) << parsed.err;
        for (const char* word : mistake.named) {
            EXPECT_NE(parsed.err.find(word), std::string::npos) << word << " in: " << parsed.err;
        }
    }
}

TEST(SaveChoice, KeepsWhatItSays) {
    EXPECT_TRUE((SaveChoice{SaveChoice::Kind::kAll, {}}.keeps(3, 10)));
    EXPECT_TRUE((SaveChoice{SaveChoice::Kind::kLast, {}}.keeps(9, 10)));
    EXPECT_FALSE((SaveChoice{SaveChoice::Kind::kLast, {}}.keeps(8, 10)));
    EXPECT_TRUE((SaveChoice{SaveChoice::Kind::kListed, {2, 5}}.keeps(5, 10)));
    EXPECT_FALSE((SaveChoice{SaveChoice::Kind::kListed, {2, 5}}.keeps(4, 10)));
}

}  // namespace
}  // namespace vellus::demo
