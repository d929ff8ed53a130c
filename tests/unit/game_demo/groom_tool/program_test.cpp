#include "game_demo/tools/groom/program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/platform/files.h"
#include "game_demo/tools/groom/command.h"
#include "modules/hair/groom/groom_file.h"
#include "tests/support/own_folder.h"

namespace vellus::groom_tool {
namespace {

struct Ended {
    int status = -1;
    std::string out;
    std::string err;
};

Ended call(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "vellus_groom");
    std::vector<const char*> argv;
    argv.reserve(arguments.size());
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    std::ostringstream out;
    std::ostringstream err;
    const int status = run(static_cast<int>(argv.size()), argv.data(), out, err);
    return {status, out.str(), err.str()};
}

class GroomTool : public testing::Test {
  protected:
    std::string file(const char* name) { return (folder_.path() / name).string(); }
    /// A few strands on a ball.
    std::string grown(const char* name, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"generate", file(name), "--sphere", "0,0,0,0.1",
                                              "--count",  "50",       "--guides", "20"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ended ended = call(arguments);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return file(name);
    }
    test::OwnFolder folder_{"groom_tool"};
};

TEST_F(GroomTool, EveryCommandExplainsItself) {
    const Ended all = call({"--help"});
    EXPECT_EQ(all.status, 0);
    for (const Command* command : commands()) {
        EXPECT_NE(all.out.find(command->name), std::string::npos) << command->name;
        const Ended one = call({command->name, "--help"});
        EXPECT_EQ(one.status, 0) << command->name;
        EXPECT_NE(one.out.find("Options"), std::string::npos) << one.out;
        EXPECT_NE(one.out.find(command->help), std::string::npos) << one.out;
    }
}

TEST_F(GroomTool, MistakesOnTheCommandLineAreOneLineAndStatusTwo) {
    const std::vector<std::vector<std::string>> mistakes = {
        {},
        {"comb"},
        {"info"},
        {"convert", "a.hair"},
        {"generate", "a.hair", "--seed", "many"},
        {"generate", "a.hair", "--sphere", "1,2,3"},
        {"convert", "a.hair", "b.hair", "--points", "1"},
        {"view", "a.hair", "--size", "big"},
        {"view", "a.hair", "--node", "head"}};
    for (const auto& arguments : mistakes) {
        const Ended ended = call(arguments);
        EXPECT_EQ(ended.status, 2) << (arguments.empty() ? "" : arguments[0]);
        EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
        EXPECT_NE(ended.err.find("--help"), std::string::npos) << ended.err;
    }
}

TEST_F(GroomTool, FailuresNameFileOrOptionAndRemedy) {
    const std::string groom = grown("a.hair");
    const struct {
        std::vector<std::string> arguments;
        std::vector<std::string> words;
    } kCases[] = {
        {{"info", file("absent.hair")}, {"absent.hair"}},
        {{"convert", groom, file("b.obj")}, {"b.obj", ".hair, .tfx or .glb"}},
        {{"generate", file("c.hair")}, {"--on", "--sphere"}},
        {{"generate", file("c.hair"), "--sphere", "0,0,0,-1"}, {"--sphere", "above 0"}},
        {{"generate", file("c.hair"), "--sphere", "0,0,0,1", "--style", "mullet"},
         {"mullet", "ponytail"}},
        {{"generate", file("c.hair"), "--sphere", "0,0,0,1", "--length", "-2"},
         {"--length", "-2", "0.001"}},
        {{"generate", file("c.hair"), "--sphere", "0,0,0,1", "--group", "_SCALP"}, {"--on"}},
        {{"generate", file("c.hair"), "--on", groom}, {"a.hair"}},
    };
    for (const auto& item : kCases) {
        const Ended ended = call(item.arguments);
        EXPECT_EQ(ended.status, 1) << item.arguments[1] << ended.err;
        EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
        for (const std::string& word : item.words) {
            EXPECT_NE(ended.err.find(word), std::string::npos) << word << " in " << ended.err;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(file("c.hair"))) << "a failure writes nothing";
}

TEST_F(GroomTool, TheSameSeedWritesTheSameFile) {
    const auto first = read_file(grown("a.hair", {"--seed", "5"}));
    const auto again = read_file(grown("b.hair", {"--seed", "5"}));
    const auto other = read_file(grown("c.hair", {"--seed", "6"}));
    ASSERT_TRUE(first && again && other);
    EXPECT_EQ(*first, *again);
    EXPECT_NE(*first, *other);
}

TEST_F(GroomTool, OptionsReachTheHair) {
    const auto groom = hair::load_groom(
        grown("a.glb", {"--points", "9", "--count", "70", "--width", "0.0002", "--taper", "0"}));
    ASSERT_TRUE(groom);
    EXPECT_EQ(groom->groom.strand_count(), 70u);
    EXPECT_EQ(groom->groom.point_count(0), 9u);
    EXPECT_FLOAT_EQ(hair::thickness_at(groom->groom, 0, 0), 2e-4f);
}

TEST_F(GroomTool, ConvertsThereAndBack) {
    const std::string glb = grown("a.glb");
    ASSERT_EQ(call({"convert", glb, file("b.hair")}).status, 0);
    ASSERT_EQ(call({"convert", file("b.hair"), file("c.tfx")}).status, 0);
    ASSERT_EQ(call({"convert", file("c.tfx"), file("d.glb")}).status, 0);
    const auto first = hair::load_groom(glb);
    const auto last = hair::load_groom(file("d.glb"));
    ASSERT_TRUE(first && last);
    ASSERT_EQ(first->groom.points.size(), last->groom.points.size());
    for (size_t p = 0; p < first->groom.points.size(); ++p) {
        EXPECT_LT(glm::distance(first->groom.points[p], last->groom.points[p]), 3e-7f);
    }
    ASSERT_EQ(call({"convert", glb, file("e.glb"), "--points", "5"}).status, 0);
    EXPECT_EQ(hair::load_groom(file("e.glb"))->groom.point_count(3), 5u);
}

TEST_F(GroomTool, InfoSaysWhatThereIs) {
    const std::string groom = grown("a.hair");
    const Ended text = call({"info", groom});
    EXPECT_EQ(text.status, 0);
    for (const char* word : {"a.hair", "50 strands", "diameter per point", "cm", "straight"}) {
        EXPECT_NE(text.out.find(word), std::string::npos) << word << " in " << text.out;
    }
    const auto json = nlohmann::json::parse(call({"info", groom, "--json"}).out, nullptr, false);
    ASSERT_TRUE(json.is_array());
    EXPECT_EQ(json[0]["strands"], 50);
    EXPECT_EQ(json[0]["points"], 50 * 16);
}

TEST_F(GroomTool, GrowsOnAJointOfAScene) {
    const std::string scene = std::string(VELLUS_SOURCE_DIR) + "/assets/scenes/portrait.gltf";
    const std::string out = file("bust.glb");
    Ended ended = call({"generate", out, "--on", scene, "--group", "head", "--count", "100"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const auto in_scene = hair::load_groom(out);
    ASSERT_TRUE(in_scene);
    // The bust stands on the ground: its head is 0.4 m up.
    EXPECT_GT(in_scene->groom.points[0].y, 0.2f);
    ended = call(
        {"generate", out, "--on", scene, "--group", "head", "--count", "100", "--space", "head"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const auto in_node = hair::load_groom(out);
    ASSERT_TRUE(in_node);
    // The head joint's rest place in that file.
    const glm::vec3 joint(0.0f, 0.4f - 0.075f, -0.020f);
    for (size_t p = 0; p < in_scene->groom.points.size(); ++p) {
        EXPECT_LT(glm::distance(in_scene->groom.points[p] - joint, in_node->groom.points[p]),
                  1e-6f);
    }
    ended = call({"generate", out, "--on", scene, "--group", "tail"});
    EXPECT_EQ(ended.status, 1);
    EXPECT_NE(ended.err.find("neck"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace vellus::groom_tool
