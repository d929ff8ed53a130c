#include "game_demo/src/panels/panels.h"

#include <imgui.h>

#include <algorithm>

namespace vellus::demo {

namespace {

void set_style() {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 4.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.WindowBorderSize = 0.0f;
    style.Colors[ImGuiCol_WindowBg] = {0.06f, 0.06f, 0.07f, 0.82f};
    style.Colors[ImGuiCol_FrameBg] = {0.22f, 0.22f, 0.25f, 0.80f};
    style.Colors[ImGuiCol_Header] = {0.30f, 0.24f, 0.18f, 0.90f};
    style.Colors[ImGuiCol_HeaderHovered] = {0.42f, 0.32f, 0.22f, 0.90f};
    style.Colors[ImGuiCol_SliderGrab] = {0.80f, 0.60f, 0.36f, 1.00f};
    style.Colors[ImGuiCol_CheckMark] = {0.90f, 0.70f, 0.42f, 1.00f};
}

}  // namespace

Result<std::unique_ptr<Panels>> Panels::create(gpu::Device& device) {
    std::unique_ptr<Panels> panels(new Panels);
    panels->context_ = ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // No file appears beside the program.
    io.LogFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    set_style();
    auto pass = PanelPass::create(device);
    if (!pass) return pass.error();
    panels->pass_ = std::move(*pass);
    return panels;
}

Panels::~Panels() {
    if (context_ != nullptr) ImGui::DestroyContext(context_);
}

void Panels::begin(const Input& input, FramebufferSize size, double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
    io.MousePos = {static_cast<float>(input.cursor_x), static_cast<float>(input.cursor_y)};
    io.MouseWheel = static_cast<float>(input.scroll_y);
    // A click within one frame is held for that frame, or ImGui would not see it.
    const auto down = [&](MouseButton button) {
        return input.button(button).held || input.button(button).pressed;
    };
    io.MouseDown[0] = down(MouseButton::kLeft);
    io.MouseDown[1] = down(MouseButton::kRight);
    io.MouseDown[2] = down(MouseButton::kMiddle);
    ImGui::NewFrame();
}

void Panels::end() {
    ImGui::Render();
}

void Panels::describe(scene::RenderFrame& frame) {
    if (const ImDrawData* data = ImGui::GetDrawData()) pass_->describe(*data, frame);
}

bool Panels::takes_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

}  // namespace vellus::demo
