// Feeds Dear ImGui from WindowEvents and draws it with its own OpenGL back end.
#include "game/view/interface.h"

#include <imgui.h>
#include <imgui/backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

/// The places of DejaVu in distributions; without it Dear ImGui's own small font is enlarged.
constexpr std::array font_files{"/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf",
                                "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans-Bold.ttf",
                                "/usr/share/fonts/TTF/DejaVuSans-Bold.ttf"};

/// Line heights of small print, menus and headlines at a window 720 pixels high.
constexpr std::array font_sizes{21.0f, 34.0f, 112.0f};

constexpr std::pair<ImGuiKey_, KeyCode> mapped_keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                         {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                         {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                         {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                         {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                         {ImGuiKey_Home, GLFW_KEY_HOME},
                                                         {ImGuiKey_End, GLFW_KEY_END},
                                                         {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                         {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                         {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                         {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                         {ImGuiKey_Space, GLFW_KEY_SPACE}};

ImU32 packed(const Colour& colour, float alpha = 1.0f) {
  return ImGui::ColorConvertFloat4ToU32(
      {colour.red, colour.green, colour.blue, colour.alpha * alpha});
}

void set_style(float unit) {
  ImGuiStyle style;
  style.WindowRounding = 14.0f * unit;
  style.WindowPadding = {30.0f * unit, 24.0f * unit};
  style.WindowBorderSize = 0.0f;
  style.FrameRounding = 8.0f * unit;
  style.FramePadding = {16.0f * unit, 7.0f * unit};
  style.ItemSpacing = {12.0f * unit, 9.0f * unit};
  style.GrabRounding = 6.0f * unit;
  style.GrabMinSize = 18.0f * unit;
  style.Colors[ImGuiCol_WindowBg] = {0.035f, 0.045f, 0.075f, 0.86f};
  style.Colors[ImGuiCol_Text] = {0.93f, 0.95f, 0.99f, 1.0f};
  style.Colors[ImGuiCol_TextDisabled] = {0.55f, 0.60f, 0.70f, 1.0f};
  style.Colors[ImGuiCol_Button] = {0.13f, 0.17f, 0.26f, 1.0f};
  style.Colors[ImGuiCol_ButtonHovered] = {0.17f, 0.42f, 0.78f, 1.0f};
  style.Colors[ImGuiCol_ButtonActive] = {0.10f, 0.55f, 0.95f, 1.0f};
  style.Colors[ImGuiCol_FrameBg] = {0.17f, 0.22f, 0.33f, 1.0f};
  style.Colors[ImGuiCol_FrameBgHovered] = {0.14f, 0.20f, 0.32f, 1.0f};
  style.Colors[ImGuiCol_FrameBgActive] = {0.14f, 0.24f, 0.40f, 1.0f};
  style.Colors[ImGuiCol_CheckMark] = {1.0f, 0.74f, 0.12f, 1.0f};
  style.Colors[ImGuiCol_SliderGrab] = {0.17f, 0.50f, 0.90f, 1.0f};
  style.Colors[ImGuiCol_SliderGrabActive] = {0.13f, 0.62f, 1.0f, 1.0f};
  style.Colors[ImGuiCol_NavHighlight] = {1.0f, 0.74f, 0.12f, 1.0f};
  style.Colors[ImGuiCol_Separator] = {0.25f, 0.30f, 0.42f, 1.0f};
  ImGui::GetStyle() = style;
}

}  // namespace

Interface::Interface() : context_(ImGui::CreateContext()) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NoMouseCursorChange;
  io.ConfigInputTextCursorBlink = false;
  for (const auto& [key, code] : mapped_keys) io.KeyMap[key] = code;
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

void Interface::receive(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  ImGuiIO& io = ImGui::GetIO();
  if (event.kind == Kind::key && event.key >= 0 && event.key < IM_ARRAYSIZE(io.KeysDown)) {
    const bool is_enter = event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
    if (is_enter && !io.WantTextInput)
      io.KeysDown[GLFW_KEY_SPACE] = event.is_down;  // which alone presses buttons
    io.KeysDown[event.key] = event.is_down;
  }
  if (event.kind == Kind::text) io.AddInputCharacter(event.character);
  else if (event.kind == Kind::mouse_move)
    io.MousePos = {static_cast<float>(event.x), static_cast<float>(event.y)};
  else if (event.kind == Kind::mouse_button) io.MouseDown[0] = event.is_down;
  else if (event.kind == Kind::scroll) io.MouseWheel += static_cast<float>(event.y);
  else if (event.kind == Kind::focus_lost) std::ranges::fill(io.KeysDown, false);
}

void Interface::make_fonts(float step) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  const auto file = std::ranges::find_if(
      font_files, [](const char* name) { return std::filesystem::exists(name); });
  for (std::size_t i = 0; i < font_sizes.size(); ++i) {
    ImFontConfig config;
    config.SizePixels = std::round(font_sizes[i] * step);
    config.OversampleH = i == 2 ? 1 : 2;
    fonts_[i] = file != font_files.end()
                    ? atlas.AddFontFromFileTTF(*file, config.SizePixels, &config)
                    : atlas.AddFontDefault(&config);
  }
  atlas.Build();
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  font_step_ = step;
}

void Interface::begin(const WindowSize& size, double elapsed_s) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  io.DeltaTime = std::max(1e-4f, static_cast<float>(elapsed_s));
  unit_ =
      std::min(static_cast<float>(size.height) / 720.0f, static_cast<float>(size.width) / 900.0f);
  const float step = std::clamp(std::round(unit_ * 4.0f) / 4.0f, 0.5f, 3.0f);
  if (step != font_step_) make_fonts(step);
  set_style(unit_);
  io.FontDefault = fonts_[1];
  io.FontGlobalScale = unit_ / step;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Interface::draw(const Picture& picture) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  if (picture.dimming > 0.0f)
    list.AddRectFilled({0.0f, 0.0f}, size, packed({0.01f, 0.015f, 0.03f, picture.dimming}));
  if (picture.is_split)
    list.AddRectFilled({0.5f * size.x - 2.0f * unit_, 0.0f}, {0.5f * size.x + 2.0f * unit_, size.y},
                       packed({0.02f, 0.03f, 0.05f, 1.0f}));
  for (const Panel& panel : picture.panels) {
    const ImVec2 low(panel.x * size.x, panel.y * size.y),
        high((panel.x + panel.width) * size.x, (panel.y + panel.height) * size.y);
    if (panel.fill.alpha > 0.0f) list.AddRectFilled(low, high, packed(panel.fill));
    if (panel.outline.alpha > 0.0f)
      list.AddRect(low, high, packed(panel.outline), 0.0f, 0, 2.0f * unit_);
  }
  for (const Text& text : picture.texts) {
    const float height = text.size * 720.0f * unit_;
    const auto larger = std::ranges::find_if(
        fonts_, [height](const ImFont* font) { return font->FontSize >= 0.8f * height; });
    ImFont* font = larger != std::end(fonts_) ? *larger : fonts_[2];
    const ImVec2 extent = font->CalcTextSizeA(height, 1e6f, 0.0f, text.words.c_str());
    const float part = text.align == Text::Align::left    ? 0.0f
                       : text.align == Text::Align::right ? 1.0f
                                                          : 0.5f;
    const ImVec2 place(std::round(text.x * size.x - part * extent.x),
                       std::round(text.y * size.y - 0.5f * extent.y));
    const float around = 0.3f * height;
    const ImVec2 low(place.x - 1.5f * around, place.y - 0.5f * around),
        high(place.x + extent.x + 1.5f * around, place.y + extent.y + 0.5f * around);
    if (text.has_plate) list.AddRectFilled(low, high, packed({0.03f, 0.04f, 0.07f, 0.78f}), around);
    const float drop = std::clamp(0.04f * height, 1.0f, 3.5f * unit_);
    list.AddText(font, height, {place.x + drop, place.y + drop},
                 packed({0.0f, 0.0f, 0.02f, 0.75f}, text.colour.alpha), text.words.c_str());
    list.AddText(font, height, place, packed(text.colour), text.words.c_str());
  }
}

void Interface::finish(const Canvas& canvas, bool is_seen) {
  if (!is_seen) return ImGui::EndFrame();
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
  glViewport(0, 0, canvas.width, canvas.height);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glBindVertexArray(0);
}

}  // namespace rink::view
