// Reads the settings' file as far as possible, and reports the faults.
#include "game/view/settings.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

constexpr const char* how_called =
    "' (keys are called: a, 7, up, left shift, space, f1, keypad 4, comma, ...)";
constexpr std::array<const char*, 2> player_tables{"left", "right"};
constexpr std::size_t errors_max = 4;  ///< shown at once; they must fit on a small screen
constexpr std::uintmax_t file_largest = 1u << 20;  ///< bytes

struct Switch {
  std::string_view name;
  bool Settings::*place;
};
constexpr std::array switches{Switch{"mute", &Settings::is_muted},
                              Switch{"full_screen", &Settings::is_full_screen},
                              Switch{"split_screen", &Settings::is_split},
                              Switch{"effects", &Settings::has_effects},
                              Switch{"reduced_motion", &Settings::has_less_motion},
                              Switch{"music", &Settings::has_music},
                              Switch{"best_of_three", &Settings::is_best_of_three},
                              Switch{"finds_matches", &Settings::finds_matches}};

/// Whether it can stand between quotes in the file.
bool is_address(std::string_view text) {
  return !text.empty() && text.size() <= address_size_max &&
         std::ranges::all_of(text, [](char letter) {
           return letter > ' ' && letter < 0x7f && letter != '"' && letter != '\\';
         });
}

class Reader {
 public:
  Reader(std::string file, ReadSettings& read) : file_(std::move(file)), read_(read) {}

  void read(const toml::table& root) {
    if (const toml::node* version = root.get("version")) read_version(*version);
    for (const auto& [key, node] : root) read_entry(key.str(), node);
    refuse_double_use();
    for (const auto& [line, words] : errors_) {
      if (read_.errors.size() == errors_max) {
        read_.errors.push_back(file_ + ": and " + std::to_string(errors_.size() - errors_max) +
                               " more like these");
        break;
      }
      read_.errors.push_back(file_ + ":" + std::to_string(line) + ": " + words);
    }
  }

 private:
  void problem(const toml::node& node, const std::string& what) {
    errors_.emplace(node.source().begin.line, what);
  }

  /// What a newer Rink has added is no fault of the player: it is said in one line.
  void read_version(const toml::node& node) {
    const auto version = node.value_exact<std::int64_t>();
    if (!version || *version < 1) return problem(node, "version must be a whole number from 1");
    is_newer_ = *version > settings_version;
    if (is_newer_)
      problem(node, "these settings are of a newer Rink (version " + std::to_string(*version) +
                        ", this one has " + std::to_string(settings_version) +
                        "); what is known of them counts");
  }

  void read_entry(std::string_view key, const toml::node& node) {
    Settings& settings = read_.settings;
    if (const auto found = std::ranges::find(switches, key, &Switch::name);
        found != switches.end()) {
      if (const auto value = node.value_exact<bool>()) settings.*found->place = *value;
      else problem(node, std::string(key) + " must be true or false");
    } else if (key == "version") {
    } else if (key == "window") {
      read_window(node);
    } else if (key == "addresses") {
      read_addresses(node);
    } else if (key == "hints_seen") {
      read_hints(node);
    } else if (key == "colours") {
      read_palette(node);
    } else if (key == "volume") {
      read_number(node, "volume", 0.0, 1.0, settings.volume);
    } else if (key == "control") {
      const auto name = node.value_exact<std::string>();
      if (const auto control = name ? control_from_name(*name) : std::nullopt)
        settings.control = *control;
      else if (!is_newer_) problem(node, "control must be \"keys\", \"pointer\" or \"gamepad\"");
    } else if (key == "dead_zone") {
      read_number(node, "dead_zone", 0.0, dead_zone_max, settings.dead_zone);
    } else if (key == "sensitivity") {
      read_number(node, "sensitivity", sensitivity_min, sensitivity_max, settings.sensitivity);
    } else if (key == "keys" && node.is_table()) {
      read_keys(*node.as_table());
    } else if (!is_newer_) {
      std::string all = "version, ";
      for (const Switch& each : switches) all += std::string(each.name) + ", ";
      problem(node, "there is no setting '" + std::string(key) + "'; there are: " + all +
                        "volume, window, colours, hints_seen, addresses, control, dead_zone, "
                        "sensitivity, keys.left, "
                        "keys.right");
    }
  }

  void read_window(const toml::node& node) {
    const toml::array* sizes = node.as_array();
    const auto number = [&](std::size_t place, int least, int most) -> std::optional<int> {
      const auto value = (*sizes)[place].value_exact<std::int64_t>();
      if (!value || *value < least || *value > most) return std::nullopt;
      return static_cast<int>(*value);
    };
    if (sizes != nullptr && sizes->size() == 2) {
      const auto width = number(0, window_least.width, window_most.width),
                 height = number(1, window_least.height, window_most.height);
      if (width && height) {
        read_.settings.window = {*width, *height};
        return;
      }
    }
    if (!is_newer_) problem(node, "window must be [width, height], from 320 and 240 to 8192");
  }

  void read_addresses(const toml::node& node) {
    const toml::array* places = node.as_array();
    if (places == nullptr || places->size() > addresses_max)
      return problem(node, "addresses must be a list of at most 5 HOST:PORT in quotes");
    for (const toml::node& each : *places) {
      const auto place = each.value_exact<std::string>();
      if (place && is_address(*place)) read_.settings.addresses.push_back(*place);
      else problem(each, "expected HOST:PORT in quotes");
    }
  }

  void read_hints(const toml::node& node) {
    const toml::array* names = node.as_array();
    if (names == nullptr) return problem(node, "hints_seen must be a list of names in quotes");
    for (const toml::node& each : *names) {
      const auto name = each.value_exact<std::string>();
      const auto found = std::ranges::find(hint_names, name ? std::string_view(*name) : "");
      if (found != hint_names.end())
        read_.settings.hints_seen[static_cast<std::size_t>(found - hint_names.begin())] = true;
      else if (!is_newer_)
        problem(each, "there is no such hint; there are: how_to_play, move, pause, camera, help");
    }
  }

  void read_palette(const toml::node& node) {
    const auto name = node.value_exact<std::string>();
    if (const auto kind = name ? palette_from_name(*name) : std::nullopt)
      read_.settings.palette = *kind;
    else if (!is_newer_) problem(node, "colours must be " + palette_names());
  }

  void read_number(const toml::node& node, const char* name, double least, double most,
                   double& number) {
    const auto value = node.value<double>();
    if (value && *value >= least && *value <= most) {
      number = *value;
      return;
    }
    std::ostringstream words;
    words << name << " must be a number from " << least << " to " << most;
    problem(node, words.str());
  }

  void read_keys(const toml::table& table) {
    for (const auto& [name, node] : table) {
      const auto player = std::ranges::find(player_tables, name.str());
      if (player == player_tables.end() || !node.is_table())
        problem(node, "keys." + std::string(name.str()) +
                          " is no player; there are: keys.left, keys.right");
      else
        read_key_set(*node.as_table(),
                     read_.settings.keys[static_cast<std::size_t>(player - player_tables.begin())]);
    }
  }

  void read_key_set(const toml::table& table, KeySet& keys) {
    for (const auto& [name, node] : table) {
      const auto key = game::key_from_name(name.str());
      if (!key) {
        problem(node, "'" + std::string(name.str()) +
                          "' is no direction; there are: left, right, up, down");
        continue;
      }
      KeyCode& place = keys[static_cast<std::size_t>(*key)];
      const std::string stays = " for " + std::string(name.str()) + "; it stays '" +
                                key_code_name(place).value_or("?") + how_called;
      const auto text = node.value_exact<std::string>();
      const auto code = text ? key_code_from_name(*text) : std::nullopt;
      if (code) place = *code;
      else if (text) problem(node, "there is no key '" + *text + "'" + stays);
      else problem(node, "expected the name of a key in quotes" + stays);
    }
  }

  /// One key cannot mean two things.
  void refuse_double_use() {
    std::vector<KeyCode> seen;
    for (const KeySet& keys : read_.settings.keys)
      for (const KeyCode code : keys) {
        if (std::ranges::find(seen, code) != seen.end()) {
          read_.errors.push_back(file_ + ": the key '" + key_code_name(code).value_or("?") +
                                 "' is given two meanings; all keys are as by default");
          read_.settings.keys = default_keys();
          return;
        }
        seen.push_back(code);
      }
  }

  std::string file_;
  ReadSettings& read_;
  bool is_newer_ = false;                             ///< the file is of a later version
  std::multimap<std::uint32_t, std::string> errors_;  ///< by line
};

}  // namespace

std::optional<Control> control_from_name(std::string_view name) {
  const auto found = std::ranges::find(control_names, name);
  if (found == control_names.end()) return std::nullopt;
  return static_cast<Control>(found - control_names.begin());
}

Settings::Settings() : keys(default_keys()) {}

void remember_address(Settings& settings, const std::string& address) {
  if (!is_address(address)) return;
  std::erase(settings.addresses, address);
  settings.addresses.insert(settings.addresses.begin(), address);
  if (settings.addresses.size() > addresses_max) settings.addresses.resize(addresses_max);
}

std::array<KeySet, 2> default_keys() {
  return {KeySet{GLFW_KEY_A, GLFW_KEY_D, GLFW_KEY_W, GLFW_KEY_S},
          KeySet{GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_UP, GLFW_KEY_DOWN}};
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
    read.errors.push_back(file + ":" + std::to_string(error.source().begin.line) + ": " +
                          std::string(error.description()) + "; all settings are as by default");
  }
  return read;
}

std::string settings_text(const Settings& settings) {
  assert(settings.volume >= 0.0 && settings.volume <= 1.0);
  std::ostringstream text;
  text << "# Rink's settings for playing. Keys are called: a, 7, up, left shift, space, f1, keypad "
          "4, comma, ...\n";
  text << "version = " << settings_version << '\n';
  for (const Switch& each : switches)
    text << each.name << " = " << (settings.*each.place ? "true" : "false") << '\n';
  text << "volume = " << settings.volume << "\nwindow = [" << settings.window.width << ", "
       << settings.window.height << "]\ncolours = \"" << palette_of(settings.palette).name
       << "\"  # " << palette_names() << "\ncontrol = \""
       << control_names[static_cast<std::size_t>(settings.control)]
       << "\"  # keys, pointer or gamepad\ndead_zone = " << settings.dead_zone
       << "\nsensitivity = " << settings.sensitivity << '\n';
  std::string seen;
  for (std::size_t hint = 0; hint < hint_names.size(); ++hint)
    if (settings.hints_seen[hint])
      seen += (seen.empty() ? "\"" : ", \"") + std::string(hint_names[hint]) + '"';
  std::string places;
  for (const std::string& place : settings.addresses)
    places += (places.empty() ? "\"" : ", \"") + place + '"';
  text << "hints_seen = [" << seen << "]\naddresses = [" << places << "]\n";
  for (std::size_t player = 0; player < player_tables.size(); ++player) {
    text << "\n[keys." << player_tables[player] << "]\n";
    for (const game::Key key : game::all_keys)
      text << game::key_name(key) << " = \""
           << key_code_name(settings.keys[player][static_cast<std::size_t>(key)]).value_or("")
           << "\"\n";
  }
  return text.str();
}

ReadSettings read_settings(const std::string& file) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::exists(file, ignored)) return {};
  ReadSettings read;
  std::ifstream stream;
  if (!std::filesystem::is_regular_file(file, ignored))
    read.errors = {file + ": not a file; all settings are as by default"};
  else if (std::filesystem::file_size(file, ignored) > file_largest)
    read.errors = {file + ": larger than 1 MiB; all settings are as by default"};
  else if (stream.open(file); !stream)
    read.errors = {file + ": cannot be read; all settings are as by default"};
  if (!read.errors.empty()) return read;
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_settings(text.str(), file);
}

Settings with_changes(Settings kept, const Settings& before, const Settings& after) {
  const auto carry = [&](auto Settings::*member) {
    if (before.*member != after.*member) kept.*member = after.*member;
  };
  for (const Switch& each : switches) carry(each.place);
  carry(&Settings::keys), carry(&Settings::control), carry(&Settings::dead_zone);
  carry(&Settings::sensitivity), carry(&Settings::volume), carry(&Settings::hints_seen);
  carry(&Settings::window), carry(&Settings::palette);
  carry(&Settings::addresses);
  return kept;
}

/// Overwrites nothing that was set aside before.
std::optional<std::string> set_settings_aside(const std::string& file) {
  constexpr int names_max = 1000;
  std::error_code problem;
  std::string aside = file + ".old";
  for (int i = 2; i < names_max && std::filesystem::exists(aside, problem); ++i)
    aside = file + ".old" + std::to_string(i);
  std::filesystem::rename(file, aside, problem);
  return problem ? std::nullopt
                 : std::optional("what stood in '" + file + "' is kept as '" + aside + "'");
}

/// Writes to a second file and renames it, so that an interruption leaves the old settings or the
/// new ones.
std::optional<std::string> write_settings(const Settings& settings, const std::string& file) {
  if (file.empty()) return "the settings cannot be kept: neither XDG_CONFIG_HOME nor HOME is set";
  std::error_code problem;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), problem);
  const std::string fresh = file + ".new";
  std::ofstream stream(fresh);
  stream << settings_text(settings);
  stream.close();
  if (stream) std::filesystem::rename(fresh, file, problem);
  if (stream && !problem) return std::nullopt;
  std::filesystem::remove(fresh, problem);
  return "cannot write the settings to '" + file + "'";
}

std::string settings_file() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0')
    return std::string(folder) + "/rink/play.toml";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::string(home) + "/.config/rink/play.toml";
  return {};
}

}  // namespace rink::view
