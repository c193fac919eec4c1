// Reads what the system says about itself and times its wake-ups.
#include "loadgen/provenance.h"

#include <sys/utsname.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "loadgen/process.h"

namespace rink::loadgen {
namespace {

std::string value_in(const char* file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (line.compare(0, key.size(), key) == 0 && colon != std::string::npos && colon + 1 < line.size()) {
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

std::string build() {
#ifdef __clang__
  const std::string compiler = __VERSION__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
#ifdef NDEBUG
  return compiler + ", asserts off";
#else
  return compiler + ", asserts on";
#endif
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    const bool is_plain = !word.empty() && word.find_first_of(" \t\n'\"\\$*?;&|<>()") == std::string::npos;
    text += (text.empty() ? "" : " ") + (is_plain ? word : "'" + word + "'");
  }
  return text;
}

std::string calibration_text(const Histogram& wake_ups) {
  const Percentiles lateness = wake_ups.percentiles_ms();
  char text[128];
  std::snprintf(text, sizeof text, "late by p50 %.3f ms, p99 %.3f ms, max %.3f ms", lateness.p50.value_or(0.0), lateness.p99.value_or(0.0),
                lateness.max.value_or(0.0));
  return text;
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
  return {{{"taken", now_utc()},
           {"command", joined(command_line)},
           {"processor", value_in("/proc/cpuinfo", "model name") + ", " + std::to_string(allowed_processors().size()) + " allowed"},
           {"memory", value_in("/proc/meminfo", "MemTotal")},
           {"kernel", kernel()},
           {"build", build()},
           {"timer wake-up", calibration_text(wake_ups)}}};
}

nlohmann::ordered_json to_json(const Provenance& provenance) {
  nlohmann::ordered_json object;
  for (const auto& [name, text] : provenance.facts) object[name] = text;
  return object;
}

}  // namespace rink::loadgen
