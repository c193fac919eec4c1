// GTK keeps gtk-enable-animations, KDE keeps AnimationDurationFactor.
#include "game/view/feel/less_motion.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <utility>

namespace rink::view {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 3> files{
    {{"gtk-4.0/settings.ini", "gtk-enable-animations"},
     {"gtk-3.0/settings.ini", "gtk-enable-animations"},
     {"kdeglobals", "AnimationDurationFactor"}}};

/// False for what cannot be read: who has said nothing wants motion.
bool is_none(std::string value) {
  std::ranges::transform(value, value.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return value == "0" || value == "false" || value == "no" || value == "off" || value == "0.0";
}

}  // namespace

bool wants_less_motion(const std::string& folder) {
  if (folder.empty()) return false;
  for (const auto& [name, key] : files) {
    std::ifstream file(folder + "/" + name);
    std::string line;
    for (int lines = 0; lines < 10'000 && std::getline(file, line); ++lines) {
      std::erase_if(line, [](unsigned char letter) { return std::isspace(letter) != 0; });
      const std::size_t equals = line.find('=');
      if (equals != std::string::npos && line.compare(0, equals, key) == 0 &&
          is_none(line.substr(equals + 1)))
        return true;
    }
  }
  return false;
}

std::string desktop_settings_folder() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0')
    return folder;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::string(home) + "/.config";
  return {};
}

}  // namespace rink::view
