// The keys of a node's players on their way to the owners of their bats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <vector>

#include "game/control/bat_controller.h"
#include "game/net/peer/shared_game.h"
#include "game/node/node_messages.h"
#include "game/peer/session/session.h"

namespace rink::game {

/// The server's thread presses, and says who leaves; all else is the session's thread's.
class SeatedPlayers {
 public:
  /// `count` players of the scene from `first` on. The game must outlive it.
  SeatedPlayers(const SharedGame& game, std::uint32_t first, std::uint32_t count);

  /// The key is felt at `time` [s] or later. Of a player who is not seated here, or no longer,
  /// nothing is sent.
  void press(std::uint32_t player, Key key, bool is_down, double time = 0.0);

  /// What the player presses from now on is not heard until it is seated here again.
  void leave(std::uint32_t player);

  /// Between windows: from now on the player is seated here, without pressed keys, unless it was;
  /// or no longer.
  void seat(std::uint32_t player);
  void unseat(std::uint32_t player);
  bool is_seated(std::uint32_t player) const;
  /// Another session begins: no key is pressed, or on its way. All nodes know by then that `known`
  /// are seated here; others wait, as in `seat`, until their bats' owners have shown them.
  void begin_session(std::span<const std::uint32_t> known);
  /// What is to be sent to the bats' owners now, by owner, ahead of the next window's claims; until
  /// the first window was played it goes with these, but where owners begin it together. Keys wait
  /// while a window is played.
  using Taken = std::map<peer::PeerNumber, ListOf<peer::Press>>;
  Taken take(peer::Session& session, bool begins_together);
  /// After a window: where the bats are now.
  void look(const peer::Session& session);

  /// From now on keys are kept until they are felt, for a loss may undo that.
  void keep_unfelt() { keeps_unfelt_ = true; }
  /// The key was felt, which nothing can undo, or will be. Of others than its own it knows nothing.
  void note_felt(const peer::Key& key);
  /// Between windows: the others have forgotten all keys that were not felt. These are sent again,
  /// ahead of newer ones.
  void send_again(const peer::Session& session);
  /// The player, who is away, holds these keys: they are released.
  void release(std::uint32_t player, const KeysHeld& held);
  /// True if a key of the player waits, or was sent and is not known to be felt.
  bool has_unfelt(std::uint32_t player);

 private:
  struct Player {
    std::uint32_t number;
    BatController pressed;
    peer::Observation seen;  ///< the newest; its time is before the start until there is one
    std::deque<peer::Press> unfelt{};  ///< in order
    std::size_t sent = 0;              ///< of these
  };
  struct Pressed {
    std::uint32_t player;
    Key key;
    bool is_down;
    double time;
  };
  Player at_start(std::uint32_t player) const;
  std::vector<Player>::iterator of_bat(std::uint32_t bat);
  struct Way {
    peer::Session& session;
    bool begins_together;
  };
  static void send(Player& player, const peer::Press& press, const Way& way, Taken& taken);
  static void send_waiting(Player& player, const Way& way, Taken& taken);
  std::vector<Player>::iterator place_of(std::uint32_t player);

  const SharedGame& game_;
  std::vector<Player> players_;  ///< by number, and so by bat
  bool keeps_unfelt_ = false;
  std::mutex mutex_;
  std::vector<Pressed> waiting_;  ///< guarded by `mutex_`, as are these:
  std::set<std::uint32_t> left_;
};

}  // namespace rink::game
