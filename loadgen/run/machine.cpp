// Reads /proc, /sys and dpkg's list.
#include "loadgen/run/machine.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "game/model/listed.h"

namespace rink::loadgen {
namespace {

/// Empty if there is no such file.
std::string first_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  line.erase(line.find_last_not_of(" \t\r\n") + 1);
  return line;
}

bool has_word(const std::filesystem::path& file, const std::string& key, const std::string& word) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(key)) return (line + " ").find(" " + word + " ") != std::string::npos;
  return false;
}

}  // namespace

std::string governor(const std::filesystem::path& root) {
  const std::filesystem::path frequency = root / "sys/devices/system/cpu/cpu0/cpufreq";
  if (!std::filesystem::exists(frequency)) return "none";
  const std::string named = first_line(frequency / "scaling_governor");
  return named.empty() ? "unknown" : named;
}

std::string virtualisation(const std::filesystem::path& root) {
  std::string seen;
  if (has_word(root / "proc/cpuinfo", "flags", "hypervisor")) {
    seen = "virtual machine";
    std::string names;
    for (const char* file :
         {"sys/class/dmi/id/sys_vendor", "sys/class/dmi/id/product_name", "sys/hypervisor/type"})
      if (const std::string name = first_line(root / file); !name.empty())
        names += (names.empty() ? "" : " ") + name;
    if (!names.empty()) seen += " (" + names + ")";
  }
  if (std::filesystem::exists(root / ".dockerenv") ||
      std::filesystem::exists(root / "run/.containerenv"))
    seen += seen.empty() ? "container" : ", container";
  return seen.empty() ? "none seen" : seen;
}

std::string load(const std::filesystem::path& root) {
  std::istringstream line(first_line(root / "proc/loadavg"));
  std::string one, five, fifteen;
  if (!(line >> one >> five >> fifteen)) return "unknown";
  return one + ", " + five + ", " + fifteen + " over 1, 5, 15 min";
}

std::string packages(const std::filesystem::path& root, std::span<const char* const> names) {
  std::ifstream stream(root / "var/lib/dpkg/status");
  std::map<std::string, std::string> versions;
  std::string name;
  bool is_installed = false;
  const auto value = [](const std::string& line) {
    return line.substr(std::min(line.find(": ") + 2, line.size()));
  };
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("Package: ")) name = value(line), is_installed = false;
    else if (line.starts_with("Status: ")) is_installed = line.ends_with(" installed");
    else if (line.starts_with("Version: ") && is_installed) versions[name] = value(line);
  }
  std::string text;
  for (const char* each : names)
    if (const auto found = versions.find(each); found != versions.end())
      game::add_to_list(text, found->first + " " + found->second);
  return text.empty() ? "unknown" : text;
}

}  // namespace rink::loadgen
