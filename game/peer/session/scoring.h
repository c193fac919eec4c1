// Goals of a game that peers share: counted by all alike, and which pucks are to come back when.
// Pure values.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "game/peer/messages.h"

namespace rink::peer {

struct GoalRules {
  std::optional<std::uint32_t> goals_to_win;
  double face_off_delay = 1.0;   ///< s: from a goal until its puck is back
  double placement_retry = 0.1;  ///< s: after which it is tried again if there is no free place
  /// Where a puck of that radius [m] may be put that went into the left goal, or the right one:
  /// `count` places of a row that is the same at all peers, from the `first` on, the best ones
  /// first; fewer at its end.
  std::function<std::vector<Vector2>(bool is_left, double radius, std::size_t first,
                                     std::size_t count)>
      places;
};

struct FaceOff {
  double time = 0.0;  ///< s
  std::uint32_t puck = 0;
  bool is_left = false;  ///< the goal in which it is
};

/// As Game's, after the same goals.
struct Scoring {
  std::uint32_t left = 0, right = 0;  ///< goals that were scored by
  bool is_over = false;
  std::vector<FaceOff> face_offs;  ///< to come, by time, then puck

  /// Goals in any order, none before those of earlier calls.
  void count(std::vector<Goal> goals, const GoalRules& rules);
  void schedule(const FaceOff& due);
  /// When the next puck is due [s]; never, if none is.
  double next() const {
    return face_offs.empty() ? std::numeric_limits<double>::infinity() : face_offs.front().time;
  }
  /// When the first puck after `time` is due [s]; never, if none is.
  double next_after(double time) const;
  /// Asserts that pucks are due in order of time, and none once all is over.
  void check() const;
};

/// What one peer says of a puck that is due: which of 64 places are taken, by what it has; and the
/// puck, if it owns it.
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
