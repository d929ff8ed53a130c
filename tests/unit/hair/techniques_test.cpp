#include "modules/hair/techniques.h"

#include <gtest/gtest.h>

namespace vellus::hair {
namespace {

TEST(Techniques, EveryIdOfEveryAxisIsChosenAndReadBack) {
    for (const std::string_view axis : axes()) {
        ASSERT_FALSE(technique_ids(axis).empty()) << axis;
        for (const std::string_view id : technique_ids(axis)) {
            HairTechniques techniques;
            ASSERT_TRUE(set_technique(techniques, axis, id)) << axis << '=' << id;
            EXPECT_EQ(technique_id(techniques, axis), id);
        }
    }
}

TEST(Techniques, AWrongAxisOrIdListsWhatThereIs) {
    HairTechniques techniques;
    const auto axis = set_technique(techniques, "shade", "karis");
    ASSERT_FALSE(axis);
    EXPECT_NE(axis.error().message().find("shadow"), std::string::npos);
    const auto id = set_technique(techniques, "opacity", "blend");
    ASSERT_FALSE(id);
    EXPECT_NE(id.error().message().find("dither_still"), std::string::npos);
}

TEST(Techniques, ASceneChangesOnlyTheAxesItNames) {
    HairTechniques techniques;
    ASSERT_TRUE(set_techniques(techniques, {.shadow = "none"}));
    EXPECT_EQ(techniques.shadow, ShadowTechnique::kNone);
    EXPECT_EQ(techniques.opacity, OpacityTechnique::kDither);
}

}  // namespace
}  // namespace vellus::hair
