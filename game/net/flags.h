// What the networked commands share on the way in and out: checked flags, last words, files for
// results, the memory they took.
#pragma once

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace rink::game {

inline constexpr double seconds_max =
    86'400.0;  ///< longest run, warm-up or patience [s]: plans and key logs are held in memory
inline constexpr std::uint32_t bats_max = 100'000, pucks_max = 1'000'000;
inline constexpr std::uint32_t sweep_ticks_max = 1'000;
inline constexpr double cell_size_min =
    1e-3;  ///< of a filter's grid [m]; smaller ones do not fit into memory
inline constexpr double view_area_max = 1e12, view_margin_max = 1e6;  ///< m^2, m

/// A number from `low` to `high`. CLI11's own checks let NaN pass and print the bounds that they
/// don't have with 309 digits.
inline CLI::Validator number_from(double low, double high) {
  char range[80];
  std::snprintf(range, sizeof range, "from %g to %g", low, high);
  const auto check = [low, high,
                      range = std::string(range)](const std::string& text) -> std::string {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
    return text + " is not a number " + range;
  };
  return CLI::Validator(check, range);
}

inline CLI::Validator not_empty() {
  return CLI::Validator(
      [](const std::string& text) {
        return text.empty() ? std::string("must not be empty") : std::string();
      },
      "");
}

/// 0, which leaves the choice to the program, or a number from `low` to `high`.
inline CLI::Validator zero_or_number_from(double low, double high) {
  const CLI::Validator from = number_from(low, high);
  const auto check = [from](const std::string& text) -> std::string {
    double value = 0.0;
    const std::string objection = from(text);
    return objection.empty() || (CLI::detail::lexical_cast(text, value) && value == 0.0)
               ? std::string()
               : objection + ", nor 0";
  };
  return CLI::Validator(check, "0 or " + from.get_description());
}

/// Throws std::runtime_error if `path` is given and cannot be written, before a run that would be
/// lost. An existing file keeps its content.
inline void require_writable(const std::string& flag, const std::string& path) {
  if (path.empty()) return;
  std::FILE* file = std::fopen(path.c_str(), "ab");
  if (file == nullptr)
    throw std::runtime_error(flag + ": cannot write '" + path + "': " + std::strerror(errno));
  std::fclose(file);
}

inline void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write '" + path + "'");
}

/// Resident memory of this process [bytes].
inline std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace rink::game
