#include "modules/hair/groom/hair_extension.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace vellus::hair {
namespace {

constexpr const char* kWhere = "scene.gltf, node 'head', VELLUS_hair";

TEST(HairExtension, EveryFieldArrives) {
    const auto hair = parse_hair_extension(R"({
        "groom": "hair/a.tfx", "upright": false,
        "transform": {"translation": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8], "scale": [2, 3, 4]},
        "width": {"root": 0.0002, "tip": 0.00005},
        "material": {"base_color": [0.1, 0.2, 0.3], "specular": 1.5, "roughness": 0.4,
            "scatter": 0.5, "shift": -0.1, "alpha": 0.9, "color_variation": 0.25,
            "root_to_tip": {"tip_color": [0.4, 0.5, 0.6], "start": 0.5}},
        "techniques": {"opacity": "dither_still", "shadow": "none", "scattering": "karis",
            "multiple": "fake_normal", "environment": "sh"}})",
                                           kWhere);
    ASSERT_TRUE(hair) << hair.error().message();
    EXPECT_EQ(hair->groom, "hair/a.tfx");
    EXPECT_FALSE(hair->upright);
    EXPECT_FLOAT_EQ(hair->width.root, 0.0002f);
    EXPECT_FLOAT_EQ(hair->width.tip_scale, 0.25f);
    EXPECT_EQ(hair->material.base_color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(hair->material.tip_color, glm::vec3(0.4f, 0.5f, 0.6f));
    EXPECT_FLOAT_EQ(hair->material.gradient_start, 0.5f);
    EXPECT_FLOAT_EQ(hair->material.color_variation, 0.25f);
    EXPECT_FLOAT_EQ(hair->material.specular, 1.5f);
    EXPECT_FLOAT_EQ(hair->material.roughness, 0.4f);
    EXPECT_FLOAT_EQ(hair->material.scatter, 0.5f);
    EXPECT_FLOAT_EQ(hair->material.shift, -0.1f);
    EXPECT_FLOAT_EQ(hair->material.alpha, 0.9f);
    EXPECT_FALSE(hair->material.use_groom_colors);
    EXPECT_EQ(hair->techniques.opacity, "dither_still");
    EXPECT_EQ(hair->techniques.environment, "sh");
    EXPECT_TRUE(hair->warnings.empty());
    // Scale by 2, turn by 2 atan2(0.6, 0.8) about Y, move: the X axis ends where trigonometry says.
    const double angle = 2.0 * std::atan2(0.6, 0.8);
    const glm::dvec3 x(hair->transform() * glm::dvec4(1, 0, 0, 1));
    EXPECT_LT(glm::distance(x, glm::dvec3(1 + 2 * std::cos(angle), 2, 3 - 2 * std::sin(angle))),
              1e-12);
}

TEST(HairExtension, OnlyTheGroomIsNeeded) {
    const auto hair = parse_hair_extension(R"({"groom": "a.hair"})", kWhere);
    ASSERT_TRUE(hair);
    EXPECT_TRUE(hair->upright);
    EXPECT_EQ(hair->transform(), glm::dmat4(1.0));
    EXPECT_EQ(hair->width.root, 0.0f);
    EXPECT_TRUE(hair->material.use_groom_colors);
    EXPECT_EQ(hair->material.tip_color, hair->material.base_color);
    EXPECT_TRUE(hair->techniques.shadow.empty());
}

TEST(HairExtension, TheBindingNamesAMeshByIndexOrName) {
    const auto none = parse_hair_extension(R"({"groom": "a.hair"})", kWhere);
    ASSERT_TRUE(none);
    EXPECT_FALSE(none->binding);
    const auto index = parse_hair_extension(R"({"groom": "a", "binding": {"mesh": 3}})", kWhere);
    ASSERT_TRUE(index) << index.error().message();
    EXPECT_EQ(index->binding->node, 3u);
    const auto name =
        parse_hair_extension(R"({"groom": "a", "binding": {"mesh": "Head"}})", kWhere);
    ASSERT_TRUE(name) << name.error().message();
    EXPECT_FALSE(name->binding->node);
    EXPECT_EQ(name->binding->name, "Head");
}

struct BadCase {
    const char* json;
    /// Parts of the message: the field, what is wrong, what is allowed.
    std::vector<std::string> parts;
};

TEST(HairExtension, ErrorsNameFileNodeFieldAndRange) {
    const std::vector<BadCase> cases = {
        {"[]", {"array", "object"}},
        {"{", {"is not JSON"}},
        {"", {"is not JSON"}},
        {"{}", {"VELLUS_hair.groom", "missing"}},
        {R"({"groom": 3})", {"VELLUS_hair.groom", "number", "string"}},
        {R"({"groom": "a", "upright": 1})", {"VELLUS_hair.upright", "true or false"}},
        {R"({"groom": "a", "width": {"root": -1}})", {"width.root", "is -1", "1e-06 to 0.05"}},
        {R"({"groom": "a", "width": {"root": 0.001, "tip": 0.002}})", {"width.tip", "wider"}},
        {R"({"groom": "a", "width": {"tip": 0.002}})", {"width.tip", "without root"}},
        {R"({"groom": "a", "binding": "Head"})", {"VELLUS_hair.binding", "string", "object"}},
        {R"({"groom": "a", "binding": {}})", {"binding.mesh", "missing", "index or the name"}},
        {R"({"groom": "a", "binding": {"mesh": ""}})", {"binding.mesh", "missing or empty"}},
        {R"({"groom": "a", "binding": {"mesh": -1}})", {"binding.mesh", "is -1", "whole number"}},
        {R"({"groom": "a", "binding": {"mesh": 1.5}})", {"binding.mesh", "is 1.5", "or a name"}},
        {R"({"groom": "a", "binding": {"mesh": [1]}})", {"binding.mesh", "is array"}},
        {R"({"groom": "a", "width": 3})", {"VELLUS_hair.width", "number", "object"}},
        {R"({"groom": "a", "material": {"roughness": 1.01}})",
         {"material.roughness", "is 1.01", "0 to 1"}},
        {R"({"groom": "a", "material": {"base_color": [1, 2]}})",
         {"material.base_color", "2 values", "3 numbers"}},
        {R"({"groom": "a", "material": {"base_color": [0, 0, 1e400]}})", {"JSON"}},
        {R"({"groom": "a", "material": {"base_color": [0, 0, null]}})", {"base_color", "null"}},
        {R"({"groom": "a", "material": {"base_color": [0, 0, 1], "melanin": {"melanin": 1}}})",
         {"material.melanin", "keep one"}},
        {R"({"groom": "a", "material": {"melanin": {"eumelanin": 1, "redness": 1}}})",
         {"melanin", "both ways"}},
        {R"({"groom": "a", "material": {"melanin": {}}})", {"melanin", "no amount"}},
        {R"({"groom": "a", "material": {"root_to_tip": {"start": 1}}})",
         {"root_to_tip.start", "0.999"}},
        {R"({"groom": "a", "transform": {"rotation": [0, 0, 0, 0]}})",
         {"transform.rotation", "quaternion"}},
        {R"({"groom": "a", "transform": {"scale": [1, 0, 1]}})", {"transform.scale", "holds 0"}},
        {R"({"groom": "a", "techniques": {"shadow": 1}})", {"techniques.shadow", "string"}},
    };
    for (const BadCase& bad : cases) {
        const auto hair = parse_hair_extension(bad.json, kWhere);
        ASSERT_FALSE(hair) << bad.json;
        const std::string message = hair.error().message();
        EXPECT_NE(message.find("scene.gltf, node 'head'"), std::string::npos) << message;
        for (const std::string& part : bad.parts) {
            EXPECT_NE(message.find(part), std::string::npos) << bad.json << ": " << message;
        }
    }
}

TEST(HairExtension, UnknownFieldsAreWarnedOfAtAnyDepth) {
    const auto hair = parse_hair_extension(
        R"({"groom": "a", "grom": 1, "extras": {}, "material": {"rougness": 0.5}})", kWhere);
    ASSERT_TRUE(hair);
    ASSERT_EQ(hair->warnings.size(), 2u);
    EXPECT_NE(hair->warnings[0].find("material.rougness"), std::string::npos);
    EXPECT_NE(hair->warnings[1].find("VELLUS_hair.grom"), std::string::npos);
}

TEST(HairExtension, MelaninDarkensAndRednessReddens) {
    const auto color = [](const std::string& melanin) {
        const auto hair = parse_hair_extension(
            R"({"groom": "a", "material": {"melanin": )" + melanin + "}}", kWhere);
        EXPECT_TRUE(hair) << hair.error().message();
        return hair->material.base_color;
    };
    // The amounts behind the sliders: -ln(1 - 0.5) = 0.6931.
    const glm::vec3 by_slider = color(R"({"melanin": 0.5, "redness": 0.25})");
    const glm::vec3 by_amount = color(R"({"eumelanin": 0.519860, "pheomelanin": 0.173287})");
    EXPECT_LT(glm::distance(by_slider, by_amount), 1e-5f);
    EXPECT_EQ(color(R"({"melanin": 0})"), glm::vec3(1.0f));
    const glm::vec3 black = color(R"({"melanin": 1})");
    EXPECT_LT(black.r, 1e-4f);
    // Amounts that absorb green alike (0.697 and 0.4 per unit): pheomelanin lets more red through.
    const glm::vec3 brown = color(R"({"eumelanin": 0.4})");
    const glm::vec3 red = color(R"({"pheomelanin": 0.697})");
    EXPECT_NEAR(red.g, brown.g, 1e-6f);
    EXPECT_GT(red.r, 1.1f * brown.r);
}

TEST(HairMaterial, ParametersOutOfRangeAreClampedAndNamed) {
    HairMaterial material;
    material.roughness = 7.0f;
    material.base_color.g = std::nanf("");
    material.shift = -1.0f;
    const auto lines = clamp_to_ranges(material);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_NE(lines[0].find("base_color[1]"), std::string::npos);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.base_color.g, HairMaterial{}.base_color.g);
    EXPECT_EQ(material.shift, -0.2f);
    EXPECT_TRUE(clamp_to_ranges(material).empty());
}

/// Every property of a schema with a default, paths joined by dots.
void collect(const nlohmann::json& schema, const std::string& path, std::vector<std::string>& out) {
    if (!schema.is_object()) return;
    for (const auto& [key, value] : schema.items()) {
        if (key == "properties") {
            for (const auto& [name, inner] : value.items()) {
                if (name == "extras" || name == "extensions") continue;
                out.push_back(path + name);
                collect(inner, path + name + ".", out);
            }
        } else if (key == "oneOf") {
            for (const auto& inner : value) collect(inner, path, out);
        }
    }
}

TEST(HairExtension, SchemaAndParserKnowTheSameFields) {
    std::ifstream file(VELLUS_SOURCE_DIR "/assets/schema/VELLUS_hair.schema.json");
    const auto schema = nlohmann::json::parse(file);
    std::vector<std::string> known;
    collect(schema, "", known);
    EXPECT_GE(known.size(), 25u);
    for (const std::string& path : known) {
        // A string where none belongs: an error that names the field, or for strings no warning.
        nlohmann::json json = {{"groom", "a"}};
        nlohmann::json* at = &json;
        std::string rest = path;
        for (size_t dot = 0; (dot = rest.find('.')) != std::string::npos;) {
            at = &(*at)[rest.substr(0, dot)];
            rest = rest.substr(dot + 1);
        }
        (*at)[rest] = "text";
        const auto hair = parse_hair_extension(json.dump(), kWhere);
        if (!hair) {
            EXPECT_NE(hair.error().message().find(rest), std::string::npos)
                << hair.error().message();
        } else {
            EXPECT_TRUE(hair->warnings.empty()) << path;
        }
    }
}

TEST(HairExtensionTest, CardsMayBeBuiltAtLoad) {
    auto hair = parse_hair_extension(
        R"({"groom":"a.hair","cards":{"count":120,"texels_per_metre":2500}})", "test");
    ASSERT_TRUE(hair) << hair.error().message();
    ASSERT_TRUE(hair->cards);
    EXPECT_EQ(hair->cards->count, 120u);
    EXPECT_FLOAT_EQ(hair->cards->texels_per_metre, 2500.0f);
    EXPECT_EQ(hair->cards->max_texels, 1u << 22u);
    EXPECT_FALSE(parse_hair_extension(R"({"groom":"a.hair"})", "test")->cards);
    const auto bad = parse_hair_extension(R"({"groom":"a.hair","cards":{"count":-1}})", "test");
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message().find("count"), std::string::npos);
}

}  // namespace
}  // namespace vellus::hair
