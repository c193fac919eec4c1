// Key changes on their way from the wire into the game: stamped, limited, acknowledged once they
// are felt, and recorded.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/model/key.h"
#include "rti/admission/token_bucket.h"
#include "rti/types.h"

namespace rink::game {

struct KeyCounters {
  std::uint64_t received = 0, applied = 0, refused = 0, over_limit = 0;
  std::uint32_t player_over_limit = 0;  ///< who sent the last of them
  std::uint64_t late = 0;               ///< of hosted matches: arrived after the instant for which
                                        ///< they were stamped, by more than 0.1 ms
};

/// When a key change came, and what is done with it.
struct KeyArrival {
  double now_s = 0.0;                ///< on the server's clock, for the limit; never decreases
  double simulated_s = 0.0;          ///< the earliest instant at which it can be felt
  std::optional<double> wanted_s{};  ///< of hosted matches: the instant for which it was stamped
  bool is_felt = true;               ///< else it is counted and acknowledged, no more
};

/// Of all players, who are numbered as the scene's bats. Knows no game: what it hands out as events
/// its owner submits, and hands in again as they were queued.
class KeyIntake {
 public:
  /// `limit_per_s`: see ServerSettings::key_limit_per_s.
  KeyIntake(std::uint32_t player_count, double limit_per_s);

  /// Somebody sits down as `player` at `now_s` of the server's clock: nothing is held or felt.
  void enter(std::uint32_t player, double now_s);
  /// He has left: what is on its way will not be acknowledged.
  void leave(std::uint32_t player);
  /// A message of `player` that a key goes down or up, as it came from the wire. The event to be
  /// submitted; nothing if the message is none, is over the limit, or is not to be felt.
  std::optional<InputEvent> accept(std::uint32_t player, bool is_down, rti::Bytes message,
                                   const KeyArrival& arrival);
  /// Lets go of all that `player` holds, at the simulated instant [s] or after his last key.
  std::vector<InputEvent> release(std::uint32_t player, double simulated_s);
  /// The game was played up to `until` [s].
  void feel_until(double until);
  /// The next game begins at 0: all that is on its way counts as felt, nothing is held or recorded.
  void begin();

  /// Key changes felt, by player.
  std::span<const std::uint32_t> felt() const { return felt_; }
  void record(const InputEvent& queued) { record_.push_back(queued); }
  /// All events as they were queued.
  const std::vector<InputEvent>& recorded() const { return record_; }
  std::vector<InputEvent> take_record() { return std::exchange(record_, {}); }
  const KeyCounters& counters() const { return counters_; }

 private:
  struct Hand {
    KeysHeld held;               ///< once all that was submitted is felt
    double last_key_s = 0.0;     ///< of hosted matches: the simulated instant of the last one
    rti::TokenBucket allowance;  ///< of key changes
  };
  struct Waiting {
    double time;
    std::uint32_t player;
  };

  double stamp(Hand& hand, const KeyArrival& arrival);

  double limit_per_s_;
  std::vector<Hand> hands_;          ///< by player
  std::vector<Waiting> waiting_;     ///< received, not yet felt
  std::vector<std::uint32_t> felt_;  ///< by player
  std::vector<InputEvent> record_;
  KeyCounters counters_;
};

}  // namespace rink::game
