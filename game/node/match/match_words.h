// What nodes say to each other of the matches that they host together.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "game/control/match_flow.h"

namespace rink::game {

/// A node's player wants something of the match.
struct MatchWish {
  enum class Kind : std::uint8_t { pause, go_on, rematch };
  Kind kind = Kind::pause;
  std::uint32_t player = 0;  ///< of a rematch
  friend bool operator==(const MatchWish&, const MatchWish&) = default;
};

template <class Stream>
bool exchange(Stream& stream, MatchWish& wish) {
  return stream.choice(wish.kind, MatchWish::Kind::rematch) && stream.number(wish.player) &&
         wish.player < 2;
}

/// How the match stands, which the referee says.
struct MatchNews {
  MatchState state;               ///< times are since the nodes' start
  std::uint64_t session = 0;      ///< the session that all play, counted from 1; 0: none so far
  std::uint32_t match = 0;        ///< that is played in it
  std::uint64_t last_window = 0;  ///< after which it ends, won or not; 0: not known yet
  friend bool operator==(const MatchNews&, const MatchNews&) = default;
  /// Its match is over, or was left by all.
  bool is_given_up() const {
    return state.number != match || state.phase == MatchPhase::waiting ||
           state.phase == MatchPhase::over;
  }
};

template <class Stream>
bool exchange(Stream& stream, MatchNews& news) {
  MatchState& state = news.state;
  constexpr auto nobody = static_cast<std::uint8_t>(Team::none);
  auto winner = static_cast<std::uint8_t>(state.winner.value_or(Team::none));
  if (!stream.numbers(news.session, news.match, news.last_window, state.number, state.until_s,
                      state.clock_real_s, state.clock_simulated_s, winner) ||
      !stream.choice(state.phase, MatchPhase::over) || !stream.truth(state.wants_rematch[0]) ||
      !stream.truth(state.wants_rematch[1]) || winner > nobody)
    return false;
  state.winner = winner == nobody ? std::nullopt : std::optional(static_cast<Team>(winner));
  return std::isfinite(state.until_s) && std::isfinite(state.clock_real_s) &&
         std::isfinite(state.clock_simulated_s);
}

}  // namespace rink::game
