#include <gtest/gtest.h>

#include "modules/hair/binding/bind_hair.h"

namespace vellus::hair {
namespace {

asset::SceneAsset three_nodes() {
    asset::SceneAsset scene;
    scene.nodes = {{.name = "root"}, {.name = "head", .mesh = 0}, {.name = "body", .mesh = 1}};
    return scene;
}

std::string message(const asset::SceneAsset& scene, const HairBindingChoice& choice) {
    const auto found = find_binding_node(scene, choice, "a.gltf: node 0 'root'");
    return found ? "found" : found.error().message();
}

TEST(BindingNode, IsFoundByIndexAndByName) {
    const asset::SceneAsset scene = three_nodes();
    EXPECT_EQ(*find_binding_node(scene, {.node = 2, .name = {}}, "here"), 2u);
    EXPECT_EQ(*find_binding_node(scene, {.node = {}, .name = "head"}, "here"), 1u);
}

TEST(BindingNode, ErrorsNameTheFieldAndWhatThereIs) {
    asset::SceneAsset scene = three_nodes();
    const auto expect = [&](const HairBindingChoice& choice, const char* what) {
        const std::string text = message(scene, choice);
        EXPECT_NE(text.find("a.gltf: node 0 'root'.binding.mesh"), std::string::npos) << text;
        EXPECT_NE(text.find(what), std::string::npos) << text;
    };
    expect({.node = 7, .name = {}}, "is 7, but there is no such node");
    expect({.node = 0, .name = {}}, "is 0, a node without a mesh");
    expect({.node = {}, .name = "hand"}, "nodes with a mesh: 1 'head', 2 'body'");
    expect({.node = {}, .name = "root"}, "no node with a mesh is called so");
    scene.nodes[2].name = "head";
    expect({.node = {}, .name = "head"}, "which nodes 1 and 2 are called");
    scene.nodes.resize(1);
    expect({.node = {}, .name = "head"}, "the scene has no node with a mesh");
}

}  // namespace
}  // namespace vellus::hair
