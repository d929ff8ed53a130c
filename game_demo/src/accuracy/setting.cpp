#include "game_demo/src/accuracy/setting.h"

#include <fmt/format.h>

#include <charconv>

#include "modules/hair/components.h"
#include "modules/light/light_set.h"
#include "modules/temporal/temporal.h"

namespace vellus::demo {

namespace {

Error wrong(std::string_view setting) {
    return {fmt::format("'{}' is no setting", setting), "",
            "detail=0.04..1, roughness=0..1, falloff=1/m, map=16..8192 or taa=on|off"};
}

bool set_number(World& world, Entity hair, std::string_view name, float value) {
    if (name == "detail" && value >= 0.04f && value <= 1.0f) {
        world.add(hair, hair::HairDetail{value});
    } else if (name == "roughness" && value >= 0.0f && value <= 1.0f) {
        world.get<hair::HairMaterial>(hair)->roughness = value;
    } else if (name == "falloff" && value >= 0.0f) {
        world.get<hair::HairShadow>(hair)->falloff = value;
    } else if (name == "map" && value >= 16.0f && value <= 8192.0f) {
        auto& shadows = world.resource<light::ShadowSettings>();
        shadows.size = static_cast<uint32_t>(value);
        shadows.fit_to_picture = false;
    } else {
        return false;
    }
    return true;
}

}  // namespace

Result<void> apply_setting(World& world, Entity hair, std::string_view setting) {
    if (setting.empty()) return {};
    const size_t equals = setting.find('=');
    if (equals == std::string_view::npos) return wrong(setting);
    const std::string_view name = setting.substr(0, equals);
    const std::string_view value = setting.substr(equals + 1);
    if (name == "taa" && (value == "on" || value == "off")) {
        world.resource<temporal::TemporalSettings>().enabled = value == "on";
        return {};
    }
    float number = 0.0f;
    const auto [end, code] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool whole = code == std::errc() && end == value.data() + value.size();
    if (!whole || !set_number(world, hair, name, number)) return wrong(setting);
    return {};
}

Result<void> apply_choice(World& world, Entity hair, const AxisChoice& choice) {
    auto& techniques = *world.get<hair::HairTechniques>(hair);
    if (auto set = hair::set_technique(techniques, choice.axis, choice.technique); !set) return set;
    return apply_setting(world, hair, choice.setting);
}

}  // namespace vellus::demo
