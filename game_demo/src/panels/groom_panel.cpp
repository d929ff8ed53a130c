#include "game_demo/src/panels/groom_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include "modules/hair/components.h"

namespace vellus::demo {

namespace {

using hair::HairMaterial;
using hair::HairShadow;
using hair::HairTechniques;
using hair::HairWidth;

bool technique_combo(HairTechniques& techniques, std::string_view axis) {
    const std::string_view now = hair::technique_id(techniques, axis);
    bool changed = false;
    if (!ImGui::BeginCombo(axis.data(), now.data())) return false;
    for (const std::string_view id : hair::technique_ids(axis)) {
        if (ImGui::Selectable(id.data(), id == now)) {
            static_cast<void>(hair::set_technique(techniques, axis, id));
            changed = true;
        }
    }
    ImGui::EndCombo();
    return changed;
}

bool edit_techniques(HairTechniques& techniques) {
    bool changed = false;
    for (const std::string_view axis : hair::axes()) changed |= technique_combo(techniques, axis);
    return changed;
}

/// Sliders take no typed numbers: the window hands over keys, not text.
bool slider(const char* label, float& value, float low, float high, const char* format = "%.3f") {
    return ImGui::SliderFloat(label, &value, low, high, format, ImGuiSliderFlags_NoInput);
}

bool edit_material(HairMaterial& material) {
    constexpr ImGuiColorEditFlags kColor =
        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoOptions;
    bool changed = ImGui::ColorEdit3("base", &material.base_color.x, kColor);
    ImGui::SameLine();
    changed |= ImGui::ColorEdit3("tip", &material.tip_color.x, kColor);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("file's colours", &material.use_groom_colors);
    changed |= slider("gradient start", material.gradient_start, 0.0f, 0.999f);
    changed |= slider("variation", material.color_variation, 0.0f, 1.0f);
    changed |= slider("specular", material.specular, 0.0f, 4.0f);
    changed |= slider("roughness", material.roughness, 0.0f, 1.0f);
    changed |= slider("scatter", material.scatter, 0.0f, 4.0f);
    changed |= slider("shift", material.shift, -0.2f, 0.2f);
    changed |= slider("opacity##alpha", material.alpha, 0.0f, 1.0f);
    return changed;
}

bool edit_shape(HairWidth& width, HairShadow& shadow) {
    float millimetres = 1e3f * width.root;
    bool changed = slider("width (0: groom's)", millimetres, 0.0f, 3.0f, "%.2f mm");
    if (changed) width.root = 1e-3f * millimetres;
    changed |= slider("tip", width.tip_scale, 0.0f, 1.0f);
    changed |= slider("shadow falloff", shadow.falloff, 0.0f, 400.0f, "%.0f /m");
    return changed;
}

/// One choice of everything for all grooms, which then change together.
void edit_all(World& world) {
    static HairTechniques techniques;
    bool first = true;
    world.query<const HairTechniques>().each([&](const HairTechniques& of_groom) {
        if (std::exchange(first, false)) techniques = of_groom;
    });
    if (first) return;
    for (const std::string_view axis : hair::axes()) {
        if (!technique_combo(techniques, axis)) continue;
        const std::string_view id = hair::technique_id(techniques, axis);
        world.query<HairTechniques>().each([&](HairTechniques& of_groom) {
            static_cast<void>(hair::set_technique(of_groom, axis, id));
        });
    }
}

}  // namespace

void groom_panel(World& world) {
    if (!ImGui::CollapsingHeader("Hair", ImGuiTreeNodeFlags_DefaultOpen)) return;
    const auto& grooms = world.resource<hair::HairLibrary>().grooms;
    size_t count = 0;
    world.query<const hair::Hair>().each([&](const hair::Hair&) { ++count; });
    if (count == 0) ImGui::TextDisabled("no hair in this scene");
    ImGui::PushItemWidth(0.55f * ImGui::GetContentRegionAvail().x);
    if (count > 1 && ImGui::TreeNodeEx("all grooms", ImGuiTreeNodeFlags_DefaultOpen)) {
        edit_all(world);
        ImGui::TreePop();
    }
    world.query<Entity, const hair::Hair, HairMaterial, HairWidth, HairShadow, HairTechniques>()
        .each([&](Entity entity, const hair::Hair& hair, HairMaterial& material, HairWidth& width,
                  HairShadow& shadow, HairTechniques& techniques) {
            const hair::LibraryGroom& groom = grooms[hair.groom];
            const std::string title = fmt::format("{}##{}", groom.name, entity.index);
            const ImGuiTreeNodeFlags flags = count == 1 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
            if (!ImGui::TreeNodeEx(title.c_str(), flags)) return;
            edit_techniques(techniques);
            edit_material(material);
            edit_shape(width, shadow);
            ImGui::TreePop();
        });
    ImGui::PopItemWidth();
}

}  // namespace vellus::demo
