// What nodes tell a node that comes too late: its players are served at one of theirs.
#pragma once

#include <optional>
#include <string>

namespace rink::game {

inline constexpr const char* late_players_come_to = "its players may come to ";

/// The ADDRESS:PORT of a refusal that ends with one; nothing in any other.
inline std::optional<std::string> place_for_late_players(const std::string& refusal) {
  const std::string words = late_players_come_to;
  const std::size_t at = refusal.rfind(words);
  if (at == std::string::npos) return std::nullopt;
  return refusal.substr(at + words.size());
}

}  // namespace rink::game
