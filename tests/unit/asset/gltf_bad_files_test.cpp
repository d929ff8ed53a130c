#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/asset/gltf.h"
#include "engine/asset/image_io.h"
#include "tests/unit/asset/scene_invariants.h"
#include "tests/unit/asset/test_files.h"

namespace vellus::asset {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& endings) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (endings.contains(entry.path().extension().string())) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Codes of the errors that the Khronos validator reports for a file.
std::set<std::string> expected_errors(const fs::path& file) {
    std::ifstream in(file.string() + ".report.json");
    const auto report = nlohmann::json::parse(in);
    std::set<std::string> codes;
    for (const auto& message : report["issues"]["messages"]) {
        if (message["severity"] == 0) {
            codes.insert(message["code"].get<std::string>());
        }
    }
    return codes;
}

/// Files without errors that we refuse all the same.
const std::map<std::string, std::string> kRefusedThoughValid = {
    {"base/accessor/unknown_type.gltf", "the validator leaves room for types of later versions"},
    {"base/asset/min_version_valid.gltf", "needs glTF 2.1"},
    {"base/buffer/non_relative_uri.gltf", "we open no network connections"},
    {"base/root/named_objects.gltf", "its mesh lies in a buffer without data"},
    {"base/root/unused_objects.gltf", "its mesh lies in a buffer without data"},
    {"base/skin/valid.gltf", "an accessor without buffer view: all inverse bind matrices are zero"},
};

/// Errors that concern nothing this engine uses, so that files with only these may load without a
/// word.
const std::map<std::string, std::string> kHarmless = {
    {"ACCESSOR_INVALID_FLOAT", "data of accessors that nothing uses is not read"},
    {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", "min and max are not used"},
    {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", "min and max are not used"},
    {"ACCESSOR_MAX_MISMATCH", "min and max are not used"},
    {"ACCESSOR_MIN_MISMATCH", "min and max are not used"},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", "min and max are not used"},
    {"MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", "min and max are not used"},
    {"ACCESSOR_INDEX_PRIMITIVE_RESTART",
     "we have no primitive restart: the largest index is an index"},
    {"BUFFER_VIEW_INVALID_BYTE_STRIDE", "targets are not used"},
    {"BUFFER_DATA_URI_MIME_TYPE_INVALID", "media types are not used"},
    {"IMAGE_MIME_TYPE_INVALID", "images are told apart by content"},
    {"INVALID_URI", "media types are not used"},
    {"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT", "attributes of applications are not read"},
    {"SKIN_SKELETON_INVALID", "the skeleton root is not used"},
    {"UNEXPECTED_EXTENSION_OBJECT", "an extension where it means nothing"},
    {"NON_REQUIRED_EXTENSION", "read whether required or not"},
};

TEST(BadFiles, ValidatorFilesLoadOrAreRefusedAsTheValidatorSays) {
    VELLUS_ASSET_FILE(folder, "bad/gltf-validator")
    const auto files = files_below(folder, {".gltf", ".glb"});
    EXPECT_EQ(files.size(), 372U);
    size_t refused = 0;
    for (const fs::path& file : files) {
        const std::string name = fs::relative(file, folder).generic_string();
        const auto errors = expected_errors(file);
        const auto scene = load_gltf(file);
        std::string verdict = scene ? "loaded" : "refused: " + scene.error().message();
        if (scene) {
            EXPECT_EQ(test::broken_promise(*scene), "") << name;
            for (const std::string& warning : scene->warnings) {
                verdict += "\n        " + warning;
            }
            const bool silent = scene->warnings.empty();
            const bool harmless =
                std::all_of(errors.begin(), errors.end(),
                            [](const std::string& code) { return kHarmless.contains(code); });
            EXPECT_TRUE(!silent || harmless)
                << name << " loads without a word in spite of " << *errors.begin();
        } else {
            ++refused;
            EXPECT_NE(scene.error().where.find(file.filename().string()), std::string::npos)
                << name;
            EXPECT_FALSE(scene.error().what.empty() || scene.error().remedy.empty()) << name;
            EXPECT_EQ(errors.empty(), kRefusedThoughValid.contains(name)) << name << " " << verdict;
        }
        std::printf("%-70s %zu errors  %s\n", name.c_str(), errors.size(), verdict.c_str());
    }
    std::printf("%zu files, %zu refused\n", files.size(), refused);
}

TEST(BadFiles, AssimpFilesLoadOrAreRefused) {
    VELLUS_ASSET_FILE(folder, "bad/assimp-glTF2")
    // What each must say; empty where the file is usable.
    const std::map<std::string, std::string> expected = {
        {"BoxBadNormals.glb", ""},
        {"BoxWithInfinites.glb", "not finite"},
        {"Cube.gltf", "of a buffer of 514 bytes"},
        {"AllIndicesOutOfRange.gltf", "there are 24 vertices"},
        {"IndexOutOfRange.gltf", "there are 24 vertices"},
        {"BoxTextured.gltf", "no such file"},
        {"RecursiveNodes.gltf", "their own ancestors"},
        {"sceneWrongType.gltf", "/scene: no integer"},
        {"NoScene.gltf", "/scene: 0 is none of the 0 scenes"},
        {"SceneWithoutNodes.gltf", ""},
        {"texcoord_crash.gltf", ""},
        {"badArray.gltf", "primitives: no array"},
        {"badExtension.gltf", "KHR_texture_transform: no object"},
        {"badNumber.gltf", "normalTexture/index: required, but missing"},
        {"badObject.gltf", "pbrMetallicRoughness: no object"},
        {"badString.gltf", "name: no string"},
        {"badUint.gltf", "index: -1 is none of the 1 textures"},
    };
    const auto files = files_below(folder, {".gltf", ".glb"});
    EXPECT_EQ(files.size(), expected.size());
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        const auto scene = load_gltf(file);
        std::printf("%-30s %s\n", name.c_str(), scene ? "loaded" : scene.error().message().c_str());
        ASSERT_TRUE(expected.contains(name)) << name;
        EXPECT_EQ(static_cast<bool>(scene), expected.at(name).empty()) << name;
        if (scene) {
            EXPECT_EQ(test::broken_promise(*scene), "") << name;
        } else {
            EXPECT_NE(scene.error().message().find(expected.at(name)), std::string::npos)
                << scene.error().message();
        }
    }
}

TEST(BadFiles, HdrFilesLoad) {
    VELLUS_ASSET_FILE(folder, "bad/image-rs-hdr")
    for (const fs::path& file : files_below(folder, {".hdr"})) {
        const auto image = load_image_f(file);
        std::printf("%-30s %s\n", file.filename().c_str(),
                    image ? "loaded" : image.error().message().c_str());
        EXPECT_TRUE(image) << file;
    }
}

TEST(BadFiles, AreRefusedByName) {
    const auto scene = load_gltf("nowhere/absent.gltf");
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message().find("absent.gltf"), std::string::npos);
}

}  // namespace
}  // namespace vellus::asset
