#include "engine/asset/json_fields.h"

#include <gtest/gtest.h>

namespace vellus::asset {
namespace {

TEST(JsonFields, TheFirstErrorStaysAndValuesAreUntouched) {
    const auto json = *parse_json(R"({"a": 5, "b": "x", "c": 1})", "file");
    JsonFields fields(json, "file");
    double a = 0.5;
    double b = 0.5;
    double c = 0.5;
    fields.number("a", 0.0, 1.0, a);
    fields.number("b", 0.0, 1.0, b);
    fields.number("c", 0.0, 1.0, c);
    ASSERT_TRUE(fields.error());
    EXPECT_EQ(fields.error()->message(), "file.a: is 5 (give a number from 0 to 1)");
    EXPECT_EQ(a, 0.5);
    EXPECT_EQ(b, 0.5);
    EXPECT_EQ(c, 1.0);
}

TEST(JsonFields, ChoicesListWhatIsAllowed) {
    const auto json = *parse_json(R"({"axis": "left"})", "file");
    JsonFields fields(json, "file");
    std::string axis = "up";
    constexpr std::string_view kAllowed[] = {"up", "down"};
    fields.choice("axis", kAllowed, axis);
    ASSERT_TRUE(fields.error());
    EXPECT_EQ(fields.error()->message(), "file.axis: is 'left' (choose one of: up, down)");
    EXPECT_EQ(axis, "up");
}

TEST(JsonFields, InnerObjectsReportTheirPathAndUnknownFields) {
    const auto json = *parse_json(R"({"in": {"x": 1, "y": 2}, "z": 3})", "file");
    JsonFields fields(json, "file");
    float x = 0.0f;
    fields.object("in", [&](JsonFields& inner) { inner.number("x", 0.0, 1.0, x); });
    EXPECT_EQ(x, 1.0f);
    EXPECT_FALSE(fields.error());
    const auto unknown = fields.unknown_fields();
    ASSERT_EQ(unknown.size(), 2u);
    EXPECT_EQ(unknown[0], "file.in.y: unknown field, ignored (known: x)");
    EXPECT_EQ(unknown[1], "file.z: unknown field, ignored (known: in)");
}

TEST(JsonFields, DeepNestingAndBrokenTextAreErrors) {
    EXPECT_FALSE(parse_json(std::string(100000, '['), "file"));
    EXPECT_FALSE(parse_json("\xff\xfe", "file"));
    EXPECT_TRUE(parse_json(std::string(1000, '[') + std::string(1000, ']'), "file"));
}

}  // namespace
}  // namespace vellus::asset
