#include "game_demo/src/panels/main_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "game_demo/src/controls.h"
#include "game_demo/src/panels/groom_panel.h"
#include "modules/character/components.h"
#include "modules/scene/library.h"
#include "modules/temporal/temporal.h"

namespace vellus::demo {

namespace {

bool slider(const char* label, float& value, float low, float high, const char* format,
            ImGuiSliderFlags flags = 0) {
    return ImGui::SliderFloat(label, &value, low, high, format, flags | ImGuiSliderFlags_NoInput);
}

/// The dearest passes of the last finished frame as bars.
void pass_bars(const graph::FrameReport& report) {
    constexpr size_t kShown = 8;
    struct Row {
        std::string_view name;
        double milliseconds;
    };
    static std::vector<Row> rows;
    rows.clear();
    double sum = 0.0;
    for (const auto& pass : report.passes) {
        rows.push_back({pass.name, pass.gpu_ms});
        sum += pass.gpu_ms;
    }
    std::ranges::sort(rows, std::greater{}, &Row::milliseconds);
    for (const Row& row : std::span(rows).first(std::min(rows.size(), kShown))) {
        char text[64];
        *fmt::format_to_n(text, sizeof(text) - 1, "{:.2f} ms", row.milliseconds).out = '\0';
        ImGui::ProgressBar(static_cast<float>(sum > 0.0 ? row.milliseconds / sum : 0.0),
                           {0.42f * ImGui::GetContentRegionAvail().x, 0.0f}, text);
        ImGui::SameLine();
        ImGui::TextUnformatted(row.name.data(), row.name.data() + row.name.size());
    }
}

void frame_section(const FrameTimes& times, Renderer& renderer) {
    if (!ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) return;
    const float last = times.last();
    ImGui::Text("%.1f ms, %.1f frames a second", last, last > 0.0f ? 1e3f / last : 0.0f);
    ImGui::PlotLines("##times", times.milliseconds.data(), FrameTimes::kCount,
                     static_cast<int>(times.next), nullptr, 0.0f, FLT_MAX,
                     {ImGui::GetContentRegionAvail().x, 36.0f});
    pass_bars(renderer.report());
}

void scene_section(DemoState& state) {
    if (!ImGui::CollapsingHeader("Scene", ImGuiTreeNodeFlags_DefaultOpen)) return;
    const std::string now = state.scenes[state.scene].stem().string();
    if (!ImGui::BeginCombo("##scene", now.c_str())) return;
    for (size_t i = 0; i < state.scenes.size(); ++i) {
        const std::string name = state.scenes[i].stem().string();
        if (ImGui::Selectable(name.c_str(), i == state.scene)) state.open_scene = i;
    }
    ImGui::EndCombo();
}

void clip_combo(World& world) {
    const auto& library = world.resource<scene::SceneLibrary>();
    world.query<const scene::InstanceRoot, character::AnimationPlayer>().each(
        [&](const scene::InstanceRoot& root, character::AnimationPlayer& player) {
            const auto& clips = library.asset_of(library.instances[root.instance]).animations;
            if (clips.size() < 2 || player.animation >= clips.size()) return;
            const std::string label = fmt::format("clip##{}", root.instance);
            if (!ImGui::BeginCombo(label.c_str(), clips[player.animation].name.c_str())) return;
            for (uint32_t i = 0; i < clips.size(); ++i) {
                if (ImGui::Selectable(clips[i].name.c_str(), i == player.animation)) {
                    player.animation = i;
                    player.mix = 0.0f;
                }
            }
            ImGui::EndCombo();
        });
}

void clock_section(DemoState& state, World& world) {
    if (!ImGui::CollapsingHeader("Clock", ImGuiTreeNodeFlags_DefaultOpen)) return;
    ImGui::Checkbox("paused", &state.paused);
    ImGui::SameLine();
    if (ImGui::Button("step")) state.paused = state.step = true;
    auto speed = static_cast<float>(state.speed);
    if (slider("speed", speed, 0.05f, 4.0f, "%.2f x", ImGuiSliderFlags_Logarithmic)) {
        state.speed = speed;
    }
    clip_combo(world);
}

void light_section(DemoState& state, const Daylight* daylight, World& world) {
    if (!ImGui::CollapsingHeader("Light", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (daylight != nullptr) {
        auto hour = static_cast<float>(daylight->hour());
        const std::string text =
            fmt::format("{:02}:{:02}", static_cast<int>(hour), static_cast<int>(hour * 60.0f) % 60);
        if (slider("time of day", hour, 0.0f, 24.0f, text.c_str())) state.hour = hour;
    }
    auto& view = world.resource<scene::ViewSettings>();
    slider("exposure", view.exposure, 0.05f, 20.0f, "%.2f", ImGuiSliderFlags_Logarithmic);
    auto& taa = world.resource<temporal::TemporalSettings>();
    ImGui::Checkbox("TAA", &taa.enabled);
    ImGui::SameLine();
    slider("blend", taa.blend, 0.01f, 1.0f, "%.2f", ImGuiSliderFlags_Logarithmic);
}

void camera_section(DemoState& state) {
    if (!ImGui::CollapsingHeader("Camera")) return;
    for (const CameraMode mode :
         {CameraMode::kScene, CameraMode::kOrbit, CameraMode::kFree, CameraMode::kFollow}) {
        if (mode != CameraMode::kScene) ImGui::SameLine();
        if (ImGui::RadioButton(text(mode), state.camera == mode)) state.camera = mode;
    }
    ImGui::Checkbox("turntable", &state.turntable);
}

}  // namespace

void main_panel(DemoState& state, const FrameTimes& times, const Daylight* daylight,
                Renderer& renderer) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({8.0f, 8.0f}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({std::min(320.0f, size.x - 16.0f), std::min(560.0f, size.y - 16.0f)},
                             ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Vellus", &state.panels)) {
        World& world = renderer.world();
        frame_section(times, renderer);
        scene_section(state);
        clock_section(state, world);
        light_section(state, daylight, world);
        camera_section(state);
        groom_panel(world);
    }
    ImGui::End();
}

void help_panel(DemoState& state) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    constexpr ImGuiWindowFlags kPlain =
        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove;
    if (ImGui::Begin("Keys", &state.help, kPlain)) ImGui::TextUnformatted(controls_help());
    ImGui::End();
}

}  // namespace vellus::demo
