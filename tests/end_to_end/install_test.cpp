#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "engine/asset/image_io.h"
#include "tests/support/own_folder.h"
#include "tests/support/process.h"

namespace vellus::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = VELLUS_SOURCE_DIR;

bool sanitized() {
    std::ifstream cache(fs::path(VELLUS_BINARY_DIR) / "CMakeCache.txt");
    for (std::string line; std::getline(cache, line);) {
        if (line.starts_with("VELLUS_SANITIZE:")) return !line.ends_with('=');
    }
    return false;
}

TEST(Install, AProgramOutsideTheTreeDrawsAGroomInFewLines) {
    if (sanitized()) GTEST_SKIP() << "the consumer is built without the sanitizers";
    const OwnFolder own("install");
    const std::string prefix = own.path() / "prefix";
    const std::string build = own.path() / "build";
    const std::string picture = own.path() / "groom.png";
    const auto succeed = [](const std::vector<std::string>& arguments) {
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.status, 0) << ended.output;
        return ended.status == 0;
    };
    ASSERT_TRUE(succeed({VELLUS_CMAKE, "--install", VELLUS_BINARY_DIR, "--prefix", prefix}));
    ASSERT_TRUE(succeed({VELLUS_CMAKE, "-S", kSource / "tests/consumer", "-B", build, "-G",
                         VELLUS_GENERATOR, "-DCMAKE_BUILD_TYPE=Release",
                         std::string("-DCMAKE_CXX_COMPILER=") + VELLUS_CXX,
                         "-DCMAKE_PREFIX_PATH=" + prefix}));
    ASSERT_TRUE(succeed({VELLUS_CMAKE, "--build", build}));
    ASSERT_TRUE(succeed({build + "/consumer", kSource / "assets/grooms/long.hair", picture}));

    const auto image = asset::load_image(picture);
    ASSERT_TRUE(image) << image.error().message();
    // Blond by default it is not: brown hair in the middle, bluish grey sky in the corner.
    const auto pixel = [&](uint32_t x, uint32_t y) {
        return image->rgba.data() + size_t{4} * (size_t{y} * image->width + x);
    };
    const uint8_t* hair = pixel(image->width / 2, image->height / 4);
    const uint8_t* sky = pixel(4, 4);
    EXPECT_GT(hair[0], hair[2] + 10);
    EXPECT_GE(sky[2], sky[0]);

    std::ifstream source(kSource / "tests/consumer/main.cpp");
    const auto lines = std::count(std::istreambuf_iterator<char>(source), {}, '\n');
    EXPECT_LT(lines, 60);
}

TEST(Install, TheHairModuleAloneNeedsNoDemoAndNoTests) {
    const OwnFolder own("hair_only");
    const std::string build = own.path();
    const Ended configured =
        run({VELLUS_CMAKE, "-S", kSource, "-B", build, "-G", VELLUS_GENERATOR,
             "-DVELLUS_MODULES=hair", "-DVELLUS_DEMO=OFF", "-DVELLUS_TESTS=OFF"});
    ASSERT_EQ(configured.status, 0) << configured.output;
    const std::string targets = run({VELLUS_CMAKE, "--build", build, "--target", "help"}).output;
    EXPECT_NE(targets.find("vellus_hair"), std::string::npos) << targets;
    for (const char* other : {"vellus_temporal", "vellus_display", "vellus_game", "unit_"}) {
        EXPECT_EQ(targets.find(other), std::string::npos) << other;
    }
    const Ended unknown = run({VELLUS_CMAKE, "-S", kSource, "-B", build, "-DVELLUS_MODULES=hare"});
    EXPECT_NE(unknown.status, 0);
    EXPECT_NE(unknown.output.find("no module \"hare\""), std::string::npos) << unknown.output;
}

TEST(Install, EveryHeaderCompilesAloneAndVulkanStaysWhereItIsNeeded) {
    if (sanitized()) GTEST_SKIP() << "the release build checks it";
    const OwnFolder own("headers");
    std::ifstream commands(fs::path(VELLUS_BINARY_DIR) / "compile_commands.json");
    if (!commands) GTEST_SKIP() << "no compile_commands.json: not configured by a preset";
    // Include paths and definitions as a translation unit of the hair module has them.
    std::vector<std::string> arguments = {kSource / "tests/consumer/check_headers", kSource,
                                          own.path(), "--", VELLUS_CXX};
    for (std::string line; std::getline(commands, line);) {
        if (line.find("vellus_hair.dir/spawn.cpp.o") == std::string::npos) continue;
        std::istringstream words(line);
        for (std::string word; words >> word;) {
            if (word == "-isystem") {
                std::string folder;
                words >> folder;
                arguments.insert(arguments.end(), {word, folder});
            } else if (word.starts_with("-I") || word.starts_with("-D")) {
                arguments.push_back(word);
            }
        }
        break;
    }
    ASSERT_GT(arguments.size(), 5u) << "no flags found";
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 0) << ended.output;
    EXPECT_NE(ended.output.find(" headers"), std::string::npos);
}

}  // namespace
}  // namespace vellus::test
