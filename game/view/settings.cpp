// Reads what it can of the settings' file and says what it cannot.
#include "game/view/settings.h"

#include <GLFW/glfw3.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rink::view {
namespace {

constexpr const char* how_called = "' (keys are called: a, 7, up, left shift, space, f1, keypad 4, comma, ...)";
constexpr std::array<const char*, 2> player_tables{"left", "right"};

class Reader {
 public:
  Reader(std::string file, ReadSettings& read) : file_(std::move(file)), read_(read) {}

  void read(const toml::table& root) {
    for (const auto& [key, node] : root) read_entry(key.str(), node);
    refuse_double_use();
  }

 private:
  void trouble(const toml::node& node, const std::string& what) { read_.troubles.push_back(file_ + ":" + std::to_string(node.source().begin.line) + ": " + what); }

  void read_entry(std::string_view key, const toml::node& node) {
    Settings& settings = read_.settings;
    if (key == "mute" || key == "full_screen" || key == "split_screen") {
      if (const auto value = node.value_exact<bool>()) (key == "mute" ? settings.is_muted : key == "full_screen" ? settings.is_full_screen : settings.is_split) = *value;
      else trouble(node, std::string(key) + " must be true or false");
    } else if (key == "volume") {
      const auto value = node.value<double>();
      if (value && *value >= 0.0 && *value <= 1.0) settings.volume = *value;
      else trouble(node, "volume must be a number from 0 to 1");
    } else if (key == "keys" && node.is_table()) {
      read_keys(*node.as_table());
    } else {
      trouble(node, "there is no setting '" + std::string(key) + "'; there are: mute, volume, full_screen, split_screen, keys.left, keys.right");
    }
  }

  void read_keys(const toml::table& table) {
    for (const auto& [name, node] : table) {
      const auto player = std::ranges::find(player_tables, name.str());
      if (player == player_tables.end() || !node.is_table()) trouble(node, "keys." + std::string(name.str()) + " is no player; there are: keys.left, keys.right");
      else read_key_set(*node.as_table(), read_.settings.keys[static_cast<std::size_t>(player - player_tables.begin())]);
    }
  }

  void read_key_set(const toml::table& table, KeySet& keys) {
    for (const auto& [name, node] : table) {
      const auto key = game::key_from_name(name.str());
      if (!key) {
        trouble(node, "'" + std::string(name.str()) + "' is no direction; there are: left, right, up, down");
        continue;
      }
      KeyCode& place = keys[static_cast<std::size_t>(*key)];
      const auto text = node.value_exact<std::string>();
      const auto code = text ? key_code_from_name(*text) : std::nullopt;
      if (code) place = *code;
      else trouble(node, "there is no key '" + node.value<std::string>().value_or("?") + "' for " + std::string(name.str()) + "; it stays '" + key_code_name(place).value_or("?") + how_called);
    }
  }

  /// One key cannot mean two things.
  void refuse_double_use() {
    std::vector<KeyCode> seen;
    for (const KeySet& keys : read_.settings.keys)
      for (const KeyCode code : keys) {
        if (std::ranges::find(seen, code) != seen.end()) {
          read_.troubles.push_back(file_ + ": the key '" + key_code_name(code).value_or("?") + "' is given two meanings; all keys are as by default");
          read_.settings.keys = default_keys();
          return;
        }
        seen.push_back(code);
      }
  }

  std::string file_;
  ReadSettings& read_;
};

}  // namespace

Settings::Settings() : keys(default_keys()) {}

std::array<KeySet, 2> default_keys() {
  return {KeySet{GLFW_KEY_A, GLFW_KEY_D, GLFW_KEY_W, GLFW_KEY_S}, KeySet{GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_UP, GLFW_KEY_DOWN}};
}

std::optional<Bound> bound(const Settings& settings, KeyCode code) {
  for (std::uint32_t hand = 0; hand < settings.keys.size(); ++hand)
    for (const game::Key key : game::all_keys)
      if (settings.keys[hand][static_cast<std::size_t>(key)] == code) return Bound{hand, key};
  return std::nullopt;
}

ReadSettings parse_settings(std::string_view text, const std::string& file) {
  ReadSettings read;
  try {
    Reader(file, read).read(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    read.troubles.push_back(file + ":" + std::to_string(error.source().begin.line) + ": " + std::string(error.description()) + "; all settings are as by default");
  }
  return read;
}

std::string settings_text(const Settings& settings) {
  std::ostringstream text;
  text << "# Rink's settings for playing. Keys are called: a, 7, up, left shift, space, f1, keypad 4, comma, ...\n";
  text << "mute = " << (settings.is_muted ? "true" : "false") << "\nvolume = " << settings.volume << "\nfull_screen = " << (settings.is_full_screen ? "true" : "false")
       << "\nsplit_screen = " << (settings.is_split ? "true" : "false") << '\n';
  for (std::size_t player = 0; player < player_tables.size(); ++player) {
    text << "\n[keys." << player_tables[player] << "]\n";
    for (const game::Key key : game::all_keys)
      text << game::key_name(key) << " = \"" << key_code_name(settings.keys[player][static_cast<std::size_t>(key)]).value_or("") << "\"\n";
  }
  return text.str();
}

ReadSettings read_settings(const std::string& file) {
  std::ifstream stream(file);
  if (file.empty() || !stream) return {};
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_settings(text.str(), file);
}

std::optional<std::string> write_settings(const Settings& settings, const std::string& file) {
  if (file.empty()) return "the settings cannot be kept: neither XDG_CONFIG_HOME nor HOME is set";
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), ignored);
  std::ofstream stream(file);
  stream << settings_text(settings);
  if (!stream.flush()) return "cannot write the settings to '" + file + "'";
  return std::nullopt;
}

std::string settings_file() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0') return std::string(folder) + "/rink/play.toml";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') return std::string(home) + "/.config/rink/play.toml";
  return {};
}

}  // namespace rink::view
