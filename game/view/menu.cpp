// One function a screen; every screen works with the mouse and with arrows, Enter and Escape.
#include "game/view/menu.h"

#include <imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/view/first_minute.h"
#include "game/view/picture_of.h"
#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

ImVec4 vector_of(const Colour& colour) {
  return {colour.red, colour.green, colour.blue, colour.alpha};
}

void words_in_the_middle(const char* words) {
  ImGui::SetCursorPosX(0.5f * (ImGui::GetWindowWidth() - ImGui::CalcTextSize(words).x));
  ImGui::TextUnformatted(words);
}

}  // namespace

void Menu::open(Screen screen) {
  if (screen == Screen::settings && screen_ != Screen::help) back_ = screen_;
  if (screen == Screen::help && screen_ != Screen::help) help_back_ = screen_;
  screen_ = screen;
  is_fresh_ = true;
  drawn_ = 0;
  binding_.reset();
}

void Menu::explain(const std::string& error, const std::optional<MatchWish>& again) {
  open(Screen::main);
  error_ = error;
  again_ = again;
}

bool Menu::take_key(KeyCode code, Settings& settings, MenuWish& wish) {
  if (binding_) {
    const Binding binding = *std::exchange(binding_, std::nullopt);
    if (code == GLFW_KEY_ESCAPE || !key_code_name(code)) return true;
    assert(binding.hand < settings.keys.size() && binding.key < settings.keys[0].size());
    KeyCode& place = settings.keys[binding.hand][binding.key];
    if (const auto other = bound(settings, code))
      settings.keys[other->hand][static_cast<std::size_t>(other->key)] =
          place;  // keys are swapped, so that none has two meanings
    place = code;
    wish.kind = MenuWish::Kind::settings_changed;
    return true;
  }
  if (screen_ == Screen::none) return false;
  if (code == GLFW_KEY_F1) {
    open(screen_ == Screen::help ? help_back_ : Screen::help);
    return true;
  }
  if (code != GLFW_KEY_ESCAPE) return false;
  if (screen_ == Screen::settings) open(back_);
  else if (screen_ == Screen::help) open(help_back_);
  else if (screen_ == Screen::paused) wish.kind = MenuWish::Kind::resume;
  else if (screen_ == Screen::over) wish.kind = MenuWish::Kind::leave;
  else open(Screen::main);
  return true;
}

bool Menu::button(const char* words) {
  if (std::exchange(is_fresh_, false)) ImGui::SetKeyboardFocusHere();
  return ImGui::Button(words, {ImGui::GetContentRegionAvail().x, 0.0f});
}

/// `middle`: the height of the panel's own middle, as a part of the window's.
void Menu::begin_panel(const char* name, float width, float middle) const {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, middle * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({width * unit_, 0.0f}, ImGuiCond_Always);
  if (is_fresh_) ImGui::SetNextWindowFocus();
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
}

void Menu::draw_title(const Palette& palette) const {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  assert(interface_ != nullptr && unit_ > 0.0f);
  ImFont* font = interface_->title_font();
  const float height = 128.0f * unit_;
  const ImVec2 screen = ImGui::GetIO().DisplaySize,
               extent = font->CalcTextSizeA(height, 1e6f, 0.0f, "RINK");
  ImVec2 place(0.5f * (screen.x - extent.x), 0.155f * screen.y - 0.5f * extent.y);
  for (const auto& [letters, colour] : {std::pair{"RI", palette.left}, {"NK", palette.right}}) {
    list.AddText(font, height, {place.x + 5.0f * unit_, place.y + 5.0f * unit_},
                 IM_COL32(0, 0, 6, 190), letters);
    list.AddText(font, height, place, ImGui::ColorConvertFloat4ToU32(vector_of(colour)), letters);
    place.x += font->CalcTextSizeA(height, 1e6f, 0.0f, letters).x;
  }
}

void Menu::draw_error() const {
  if (error_.empty()) return;
  ImGui::PushFont(interface_->small_font());
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.62f, 0.52f, 1.0f));
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(error_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

MenuWish Menu::draw(const Interface& interface, Settings& settings, const MatchSight& sight) {
  MenuWish wish;
  ++drawn_;
  interface_ = &interface;
  unit_ = interface.unit();
  if (screen_ != Screen::none && screen_ != Screen::over && screen_ != Screen::paused &&
      screen_ != Screen::help)
    draw_title(palette_of(settings.palette));
  switch (screen_) {
    case Screen::none:
      break;
    case Screen::main:
      draw_main(wish);
      break;
    case Screen::bot:
      draw_bot(wish);
      break;
    case Screen::host:
      draw_address(wish, MatchWish::Kind::host, settings);
      break;
    case Screen::join:
      draw_address(wish, MatchWish::Kind::join, settings);
      break;
    case Screen::watch:
      draw_address(wish, MatchWish::Kind::watch, settings);
      break;
    case Screen::settings:
      draw_settings(settings, wish);
      break;
    case Screen::paused:
      draw_paused(wish);
      break;
    case Screen::over:
      draw_over(wish, sight);
      break;
    case Screen::help:
      draw_help(settings);
      break;
  }
  if (wish.kind == MenuWish::Kind::play) error_.clear();
  return wish;
}

void Menu::draw_main(MenuWish& wish) {
  begin_panel("main", 470.0f, 0.60f);
  if (!error_.empty() && again_ && button("Try again")) wish = {MenuWish::Kind::play, *again_};
  if (button("Two players"))
    wish = {MenuWish::Kind::play, {.kind = MatchWish::Kind::two, .address = {}}};
  if (button("Against a bot")) open(Screen::bot);
  if (button("Host a match")) open(Screen::host);
  if (button("Join a match")) open(Screen::join);
  if (button("Watch")) open(Screen::watch);
  if (button("Settings")) open(Screen::settings);
  if (button("Quit")) wish.kind = MenuWish::Kind::quit;
  draw_error();
  ImGui::End();
}

void Menu::draw_bot(MenuWish& wish) {
  begin_panel("bot", 470.0f, 0.56f);
  words_in_the_middle("How strong?");
  constexpr std::array labels{"Beginner", "Club player", "Expert"};
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (button(labels[i]))
      wish = {MenuWish::Kind::play,
              {.kind = MatchWish::Kind::bot, .strength = bot_strengths[i], .address = {}}};
  ImGui::Separator();
  if (button("Back")) open(Screen::main);
  ImGui::End();
}

void Menu::draw_address(MenuWish& wish, MatchWish::Kind kind, const Settings& settings) {
  const bool hosts = kind == MatchWish::Kind::host, joins = kind == MatchWish::Kind::join;
  begin_panel("address", 560.0f, 0.56f);
  words_in_the_middle(hosts ? "Host a match" : joins ? "Join a match" : "Watch a match or a crowd");
  std::string& text = hosts ? port_ : address_;
  if (drawn_ == 1 && !hosts && !settings.addresses.empty()) text = settings.addresses.front();
  if (std::exchange(is_fresh_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  const bool is_entered = ImGui::InputTextWithHint(
      "##address", hosts ? "port" : "host:port", &text,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (button(hosts ? "Host" : joins ? "Join" : "Watch") || is_entered)
    wish = {MenuWish::Kind::play, {.kind = kind, .address = text}};
  if (!hosts) draw_places(wish, kind, settings);
  ImGui::Separator();
  if (button("Back")) open(Screen::main);
  draw_error();
  ImGui::End();
}

/// Matches of the local network, then addresses that were joined before.
void Menu::draw_places(MenuWish& wish, MatchWish::Kind kind, const Settings& settings) {
  constexpr std::size_t found_most = 6;  // for which there is room
  ImGui::PushFont(interface_->small_font());
  const auto place_button = [&](const std::string& words, const std::string& place) {
    if (button((words + "##" + place).c_str()))
      wish = {MenuWish::Kind::play, {.kind = kind, .address = place}};
  };
  const bool searches = settings.finds_matches && find_matches;
  std::vector<game::FoundMatch> found = searches ? find_matches() : std::vector<game::FoundMatch>();
  if (found.size() > found_most) found.resize(found_most);
  if (searches)
    words_in_the_middle(found.empty() ? "No match on this network yet" : "On this network");
  for (const game::FoundMatch& match : found)
    place_button(match.name + "   " + match.place + "   " +
                     (match.is_same_version
                          ? std::to_string(std::max(1L, std::lround(1e3 * match.ping_s))) + " ms"
                          : "another version"),
                 match.place);
  std::vector<std::string> before = settings.addresses;
  std::erase_if(before, [&](const std::string& place) {
    return std::ranges::find(found, place, &game::FoundMatch::place) != found.end();
  });
  if (!before.empty()) words_in_the_middle("Joined before");
  for (const std::string& place : before) place_button(place, place);
  ImGui::PopFont();
}

void Menu::draw_keys(Settings& settings) {
  constexpr std::array directions{"left", "right", "up", "down"};
  const Palette& palette = palette_of(settings.palette);
  if (!ImGui::BeginTable("keys", 3, ImGuiTableFlags_SizingStretchSame)) return;
  ImGui::TableNextRow();
  for (const auto& [column, words, colour] :
       {std::tuple{1, palette.left_name, palette.left}, {2, palette.right_name, palette.right}}) {
    ImGui::TableSetColumnIndex(column);
    ImGui::TextColored(vector_of(colour), "%s", words);
  }
  for (std::size_t key = 0; key < directions.size(); ++key) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(directions[key]);
    for (std::size_t hand = 0; hand < settings.keys.size(); ++hand) {
      ImGui::TableSetColumnIndex(static_cast<int>(hand) + 1);
      const bool is_waiting = binding_ && binding_->hand == hand && binding_->key == key;
      const std::string words =
          (is_waiting ? "press a key" : key_code_name(settings.keys[hand][key]).value_or("?")) +
          "##" + std::to_string(hand * 4 + key);
      if (button(words.c_str())) binding_ = Binding{hand, key};
    }
  }
  ImGui::EndTable();
}

/// Further sliders are there only for who needs them.
void Menu::draw_control(Settings& settings) const {
  constexpr std::array labels{"Control: keys", "Control: pointer", "Control: gamepad"};
  const auto number = static_cast<std::size_t>(settings.control);
  ImGui::SameLine();
  if (ImGui::Button((std::string(labels[number]) + "##control").c_str()))
    settings.control = static_cast<Control>((number + 1) % labels.size());
  if (settings.control == Control::keys) return;
  const auto slider = [this](const char* words, double least, double most, double& value) {
    auto now = static_cast<float>(value);
    ImGui::SetNextItemWidth(190.0f * unit_);
    if (ImGui::SliderFloat(words, &now, static_cast<float>(least), static_cast<float>(most),
                           "%.2f"))
      value = std::clamp(static_cast<double>(now), least, most);
  };
  slider("Sensitivity", sensitivity_min, sensitivity_max, settings.sensitivity);
  if (settings.control != Control::gamepad) return;
  ImGui::SameLine();
  slider("Dead zone", 0.0, dead_zone_max, settings.dead_zone);
}

void Menu::draw_settings(Settings& settings, MenuWish& wish) {
  begin_panel("settings", 760.0f, 0.60f);
  const Settings before = settings;
  draw_keys(settings);
  ImGui::Separator();
  ImGui::PushFont(interface_->small_font());
  ImGui::Checkbox("Mute", &settings.is_muted);
  ImGui::SameLine();
  float volume = static_cast<float>(settings.volume);
  ImGui::SetNextItemWidth(320.0f * unit_);
  if (ImGui::SliderFloat("Volume", &volume, 0.0f, 1.0f, "%.2f"))
    settings.volume = std::clamp(static_cast<double>(volume), 0.0, 1.0);
  if (ImGui::Checkbox("Full screen", &settings.is_full_screen))
    wish.kind = MenuWish::Kind::full_screen;
  ImGui::SameLine();
  ImGui::Checkbox("Split screen for two", &settings.is_split);
  draw_control(settings);
  const auto palette = static_cast<std::size_t>(settings.palette);
  if (ImGui::Button((std::string(palettes[palette].label) + "##colours").c_str()))
    settings.palette = static_cast<PaletteKind>((palette + 1) % palettes.size());
  ImGui::SameLine();
  ImGui::Checkbox("Effects", &settings.has_effects);
  ImGui::SameLine();
  ImGui::Checkbox("Less motion", &settings.has_less_motion);
  ImGui::Checkbox("Music", &settings.has_music);
  ImGui::SameLine();
  ImGui::Checkbox("Best of three", &settings.is_best_of_three);
  ImGui::SameLine();
  ImGui::Checkbox("Find matches", &settings.finds_matches);
  ImGui::SameLine();
  if (ImGui::Button("Usual keys")) settings.keys = default_keys();
  ImGui::PopFont();
  if (button("Back")) open(back_);
  ImGui::End();
  if (settings != before && wish.kind == MenuWish::Kind::nothing)
    wish.kind = MenuWish::Kind::settings_changed;
}

void Menu::draw_help(const Settings& settings) {
  begin_panel("help", 800.0f, 0.5f);
  words_in_the_middle("Keys");
  ImGui::PushFont(interface_->small_font());
  if (ImGui::BeginTable("all keys", 2, ImGuiTableFlags_SizingStretchProp)) {
    for (const auto& [keys, meaning] : all_keys(settings)) {
      ImGui::TableNextRow();
      ImGui::TableSetColumnIndex(0);
      ImGui::TextColored(vector_of(palette_of(settings.palette).ring), "%s", keys.c_str());
      ImGui::TableSetColumnIndex(1);
      ImGui::TextUnformatted(meaning.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::PopFont();
  if (button("Back")) open(help_back_);
  ImGui::End();
}

void Menu::draw_paused(MenuWish& wish) {
  begin_panel("paused", 420.0f, 0.70f);
  if (button("Go on")) wish.kind = MenuWish::Kind::resume;
  if (button("Settings")) open(Screen::settings);
  if (button("Leave the match")) wish.kind = MenuWish::Kind::leave;
  ImGui::End();
}

void Menu::draw_over(MenuWish& wish, const MatchSight& sight) {
  begin_panel("over", 420.0f, 0.74f);
  if (sight.wants_rematch) words_in_the_middle("Waiting for the other");
  else if (sight.can_rematch && button("Rematch")) wish.kind = MenuWish::Kind::rematch;
  if (sight.other_wants_rematch) words_in_the_middle("The other wants a rematch");
  if (button("Menu")) wish.kind = MenuWish::Kind::leave;
  ImGui::End();
}

}  // namespace rink::view
