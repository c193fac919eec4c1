// Takes key changes and pushes from the wire into the game: they are stamped, limited, acknowledged
// once in effect, and recorded.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/model/key.h"
#include "rti/admission/token_bucket.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::game {

/// Pushes per second and player: one a frame of the fastest common screens. Clients send no more
/// than 200.
inline constexpr double push_limit_default = 240.0;

/// Of key changes and pushes together.
struct KeyCounters {
  std::uint64_t received = 0, applied = 0, refused = 0, over_limit = 0;
  std::uint32_t player_over_limit = 0;  ///< the sender of the last of them
  bool is_push_over_limit = false;      ///< whether that was a push
  std::uint64_t pushes = 0;             ///< of `received`
  std::uint64_t late = 0;               ///< of hosted matches: arrived after the instant for which
                                        ///< they were stamped, by more than 0.1 ms
};

/// The arrival of a key change, and whether it is applied.
struct KeyArrival {
  double now_s = 0.0;                ///< on the server's clock, for the limit; never decreases
  double simulated_s = 0.0;          ///< the earliest instant at which it can be felt
  std::optional<double> wanted_s{};  ///< of hosted matches: the instant for which it was stamped
  bool is_felt = true;               ///< else it is counted and acknowledged, no more
};

/// For all players, numbered as the scene's bats. Knows no game: its owner submits the returned
/// events, and records them as they were queued.
class KeyIntake {
 public:
  /// `limit_per_s`, `push_limit_per_s`: see ServerSettings.
  KeyIntake(std::uint32_t player_count, double limit_per_s,
            double push_limit_per_s = push_limit_default);

  /// `player` takes the seat at `now_s` of the server's clock, without held or counted keys.
  void enter(std::uint32_t player, double now_s);
  /// `player` has left: keys on their way are not acknowledged.
  void leave(std::uint32_t player);
  /// Handles `player`'s message of a key change from the wire. Returns the event to submit; nothing
  /// if the message is malformed, over the limit, or not to be applied.
  std::optional<InputEvent> accept(std::uint32_t player, bool is_down, rti::Bytes message,
                                   const KeyArrival& arrival);
  /// As accept, of `player`'s push.
  std::optional<InputEvent> accept_push(std::uint32_t player, rti::Bytes message,
                                        const KeyArrival& arrival);
  /// Counts a push to a game that takes none.
  void refuse_push() { ++counters_.received, ++counters_.pushes, ++counters_.refused; }
  /// Ends the push and releases all keys of `player`, at the simulated instant [s] or after its
  /// last key.
  std::vector<InputEvent> release(std::uint32_t player, double simulated_s);
  /// The game was played up to `until` [s].
  void feel_until(double until);
  /// Of a shared simulation: the player's earliest key that was submitted and not felt has taken
  /// effect.
  void feel_next(std::uint32_t player);
  /// Of a shared simulation: keys that were not submitted count as felt once all before them are.
  void feel_unsubmitted();
  /// The next game begins at 0: all keys on their way count as in effect, none is held or recorded.
  void begin();

  /// Key changes in effect, by player.
  std::span<const std::uint32_t> felt() const { return felt_; }
  void record(const InputEvent& queued) { record_.push_back(queued); }
  /// All events as they were queued.
  const std::vector<InputEvent>& recorded() const { return record_; }
  const KeyCounters& counters() const { return counters_; }

 private:
  struct Hand {
    KeysHeld held{};  ///< once all that was submitted is felt, as is the push
    Push push{};
    double last_key_s = 0.0;  ///< of hosted matches: the simulated instant of the last one
    rti::TokenBucket allowance, push_allowance;
  };
  struct Waiting {
    double time;
    std::uint32_t player;
    bool is_submitted = false;  ///< else over the limit, or not to be felt
  };

  Hand fresh_hand(double now_s) const;
  double stamp(Hand& hand, const KeyArrival& arrival);
  enum class Input : std::uint8_t { key, push, push_end };
  std::optional<double> admit(std::uint32_t player, Input input, const KeyArrival& arrival);

  double limit_per_s_, push_limit_per_s_;
  std::vector<Hand> hands_;          ///< by player
  std::vector<Waiting> waiting_;     ///< received, not yet felt
  std::vector<std::uint32_t> felt_;  ///< by player
  std::vector<InputEvent> record_;
  KeyCounters counters_;
};

}  // namespace rink::game
