// How commands take a seed.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>
#include <system_error>

namespace rink::game {

/// A whole number below 2^64. CLI11 itself takes -1 for 2^64 - 1.
inline CLI::Validator seed_number() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        return error == std::errc() && end == text.data() + text.size()
                   ? ""
                   : text + " is not a whole number from 0 to 18446744073709551615";
      },
      "");
}

}  // namespace rink::game
