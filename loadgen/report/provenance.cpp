// Reads facts about the system and times its wake-ups.
#include "loadgen/report/provenance.h"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "game/model/report_schema.h"
#include "game/process/process.h"
#include "game/version/version.h"
#include "loadgen/measure/formatted.h"
#include "loadgen/run/machine.h"

namespace rink::loadgen {
namespace {

std::string value_in(const char* file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (line.compare(0, key.size(), key) == 0 && colon != std::string::npos &&
        colon + 1 < line.size()) {
      return line.substr(std::min(line.find_first_not_of(" \t", colon + 1), line.size()));
    }
  }
  return "unknown";
}

std::string kernel() {
  utsname system{};
  if (uname(&system) != 0) return "unknown";
  return std::string(system.sysname) + " " + system.release + " " + system.machine;
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &parts);
  return text;
}

std::string compiler() {
#ifdef __clang__
  const std::string name = __VERSION__;
#else
  const std::string name = "GCC " __VERSION__;
#endif
#ifdef NDEBUG
  return name + ", asserts off";
#else
  return name + ", asserts on";
#endif
}

std::string libraries() {
  std::ostringstream text;
  text << "nlohmann-json " << NLOHMANN_JSON_VERSION_MAJOR << "." << NLOHMANN_JSON_VERSION_MINOR
       << "." << NLOHMANN_JSON_VERSION_PATCH << ", Eigen " << EIGEN_WORLD_VERSION << "."
       << EIGEN_MAJOR_VERSION << "." << EIGEN_MINOR_VERSION << ", glibc " << gnu_get_libc_version();
  return text.str();
}

std::string command_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    const bool is_plain =
        !word.empty() && word.find_first_of(" \t\n'\"\\$*?;&|<>()") == std::string::npos;
    text += (text.empty() ? "" : " ") + (is_plain ? word : "'" + word + "'");
  }
  return text;
}

std::string calibration_text(const Histogram& wake_ups) {
  const Percentiles lateness = wake_ups.percentiles_ms();
  return formatted("late by p50 %.3f ms, p99 %.3f ms, max %.3f ms", lateness.p50.value_or(0.0),
                   lateness.p99.value_or(0.0), lateness.max.value_or(0.0));
}

constexpr std::array packages_that_matter{"g++",
                                          "libc6",
                                          "libasio-dev",
                                          "libeigen3-dev",
                                          "libspdlog-dev",
                                          "libtomlplusplus-dev",
                                          "libpugixml-dev",
                                          "libsodium-dev",
                                          "libcli11-dev",
                                          "nlohmann-json3-dev"};

void add_program_and_machine(Provenance& provenance) {
  const std::vector<std::pair<std::string, std::string>> facts{
      {"commit", game::built_commit()},
      {"version", game::built_version()},
      {"compiler", compiler()},
      {"flags", game::built_flags()},
      {"libraries", libraries()},
      {"processor", value_in("/proc/cpuinfo", "model name")},
      {"cores", std::to_string(game::allowed_processors().size()) + " allowed of " +
                    std::to_string(std::thread::hardware_concurrency())},
      {"memory", value_in("/proc/meminfo", "MemTotal")},
      {"governor", governor("/")},
      {"virtualisation", virtualisation("/")},
      {"kernel", kernel()},
      {"packages", packages("/", packages_that_matter)}};
  provenance.facts.insert(provenance.facts.end(), facts.begin(), facts.end());
}

}  // namespace

Histogram wake_up_lateness() {
  using Clock = std::chrono::steady_clock;
  Histogram lateness;
  for (int i = 0; i < 1'000; ++i) {
    const auto due = Clock::now() + std::chrono::microseconds(200);
    std::this_thread::sleep_until(due);
    lateness.record(std::chrono::duration<double>(Clock::now() - due).count());
  }
  return lateness;
}

Provenance provenance_of(const std::vector<std::string>& command_line, const Histogram& wake_ups) {
  Provenance provenance{{{"schema", std::to_string(game::report_schema)},
                         {"taken", now_utc()},
                         {"command", command_text(command_line)}}};
  add_program_and_machine(provenance);
  provenance.facts.emplace_back("load", load("/"));
  provenance.facts.emplace_back("timer wake-up", calibration_text(wake_ups));
  return provenance;
}

Provenance reproducible_provenance_of(const std::vector<std::string>& command_line) {
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < command_line.size(); ++i) {
    const std::string& word = command_line[i];
    if (word == "--out") ++i;
    else if (!word.starts_with("--out=") && word != "--force" && word != "--resume")
      kept.push_back(i == 0 ? std::filesystem::path(word).filename().string() : word);
  }
  Provenance provenance{
      {{"schema", std::to_string(game::report_schema)}, {"command", command_text(kept)}}};
  add_program_and_machine(provenance);
  return provenance;
}

std::string comment_lines(const Provenance& provenance) {
  std::string lines;
  for (const auto& [name, fact] : provenance.facts) {
    std::string line = name + ": " + fact;
    std::replace_if(
        line.begin(), line.end(), [](char letter) { return letter == '\n' || letter == '\r'; },
        ' ');
    lines += "# " + line + "\n";
  }
  return lines;
}

nlohmann::ordered_json to_json(const Provenance& provenance) {
  nlohmann::ordered_json object;
  for (const auto& [name, text] : provenance.facts) object[name] = text;
  return object;
}

}  // namespace rink::loadgen
