// Goals of a game that peers share, counted equally by all, and the pucks to put back. Pure values.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "game/peer/messages.h"
#include "game/physics/halves/halves.h"

namespace rink::peer {

struct GoalRules {
  std::optional<std::uint32_t> goals_to_win;
  double face_off_delay = 1.0;   ///< s: from a goal until its puck is back
  double placement_retry = 0.1;  ///< s: until the next try if there is no free place
  /// How long a puck may stay in one half [s]; 0: as long as it likes. Otherwise each peer must
  /// have the whole to itself.
  double possession = 0.0;
  /// The places for a puck of that radius [m] that the left or the right side is to have: `count`
  /// of a row that is equal at all peers, from the `first` on, the best ones first; fewer at its
  /// end.
  std::function<std::vector<Vector2>(bool is_left, double radius, std::size_t first,
                                     std::size_t count)>
      places;
};

struct FaceOff {
  double time = 0.0;  ///< s
  std::uint32_t puck = 0;
  bool is_left = false;  ///< the goal in which it is
};

/// The score as Game's after the same goals.
struct Scoring {
  std::uint32_t left = 0, right = 0;  ///< goals scored by
  bool is_over = false;
  std::vector<FaceOff> face_offs;  ///< to come, by time, then puck
  physics::Halves halves{};        ///< of pucks whose stays are limited, until it is over

  /// Counts goals, in any order, none before those of earlier calls.
  void count(std::vector<Goal> goals, const GoalRules& rules);
  void schedule(const FaceOff& due);
  /// The time at which the next puck is due to come back [s]; infinite if none is.
  double next() const {
    return face_offs.empty() ? std::numeric_limits<double>::infinity() : face_offs.front().time;
  }
  /// The first time after `time` at which a puck is due to come back, or to go to the other side
  /// [s]; infinite if none is.
  double next_after(double time) const;
  /// Asserts that pucks are due in order of time, and none once all is over.
  void check() const;
};

/// A peer's message about a due puck: which of 64 places its bodies take; and the puck, if it owns
/// it.
struct FaceOffWord {
  std::uint32_t puck = 0;
  std::uint64_t taken = 0;  ///< bit k: the k-th place
  std::vector<Handover::Body> body;
};

template <class Stream>
bool exchange(Stream& stream, FaceOffWord& word) {
  return stream.numbers(word.puck, word.taken) && exchange_list(stream, word.body);
}
std::vector<std::uint8_t> written(FaceOffWord message);
bool read(std::span<const std::uint8_t> bytes, FaceOffWord& message);

}  // namespace rink::peer
