// What nodes that host a match say before each of its windows, which each of them plays whole.
#pragma once

#include <cassert>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/model/key.h"
#include "game/net/peer/shared_game.h"
#include "game/node/match/match_members.h"
#include "game/node/node_seats.h"
#include "game/peer/messages.h"
#include "game/peer/session/session.h"

namespace rink::game {

/// A key of a player's bat.
struct RoundKey {
  static constexpr std::uint32_t codes = 8 * 9, steps_max = 1u << 15;  ///< half a second
  std::uint32_t player = 0;
  std::uint32_t code = 0;   ///< the input (peer::Key) less 1, and 8 times the direction of the held
                            ///< keys: 0 to 8, by rows of y and in them by x
  std::uint32_t steps = 0;  ///< of key_grid from the window's start on: not felt before
};

/// A node's word to all others before a window. It goes with a check of the sender's state then,
/// which must be the receiver's.
struct Round {
  static constexpr std::size_t keys_max = 256;
  std::uint64_t window = 0;  ///< how many have been played; only its lowest six bits are sent
  std::vector<RoundKey> keys{};
};

template <class Stream>
bool exchange(Stream& stream, RoundKey& key) {
  return stream.varint(key.player) && stream.varint(key.code) && stream.varint(key.steps) &&
         key.code < RoundKey::codes && key.steps <= RoundKey::steps_max;
}

/// head:1 (window:6, whether keys follow, 1), keys; four bytes of check.
std::vector<std::uint8_t> written(const Round& round, std::uint64_t state);
/// What is wrong with the bytes, as in "is in another state"; empty if they are this window's round
/// of a node in this state.
std::string fault_of(std::span<const std::uint8_t> bytes, std::uint64_t state, Round& round);

/// Of the bodies and of the score.
std::uint64_t state_of(const peer::Session& session);

/// The bat's thrust [m/s^2] by the code, with the same bits as BatController's.
peer::Vector2 thrust_of(const RoundKey& key, double thrust);

/// A match is small, so what two nodes would tell each other of their parts is more than the keys
/// from which each can compute the other's. All nodes feel all keys at the same instants: those
/// that were said before a window, from its start on. So they stay equal bit for bit, and a round
/// takes one one-way delay. Used by the thread that plays.
class MatchRounds {
 public:
  /// Another session begins, in which nothing is pressed.
  void begin_session() { window_ = 0, pressed_.clear(), felt_.clear(); }
  /// A key of a player of this node, which waits for the next round.
  void press(const peer::Press& press) { pressed_.push_back(press); }
  /// Equal at all, after the last round of a lost node: the keys of its player that all that was
  /// said leaves pressed are released after that, from `from_s` on [s], when the window after the
  /// next round ends.
  void release(const SharedGame& game, std::uint32_t player, double from_s, peer::Session& session);
  /// How many rounds of the session are over.
  std::uint64_t window() const { return window_; }
  /// Before a window of the session, of which this node plays the whole: says what was pressed
  /// here, waits for the others, and lets the session feel all keys. Keys of a bat wait until it
  /// has been given to this node. Who says what cannot be is given up, if others can go on. Throws
  /// peer::ProtocolError, which names it, and peer::Halt.
  void exchange(MatchMembers& members, const SharedGame& game, const NodeSeats& seats,
                peer::Session& session);
  /// After the last window: all have ended in the same state. Throws as `exchange` does.
  void confirm(MatchMembers& members, std::uint64_t state);

 private:
  std::vector<RoundKey> take_keys(const SharedGame& game, const NodeSeats& seats, double start);
  /// By node, the own one included; without keys of those that say nothing, or what cannot be.
  std::vector<Round> said_by_all(MatchMembers& members, Round own, std::uint64_t state) const;

  /// By what was said in all rounds.
  struct Felt {
    KeysHeld held;
    double last = 0.0;        ///< when its last key is felt [s]
    double released_s = 0.0;  ///< not before that, since a lost node's were released then
  };
  /// All nodes feel it.
  void feel(peer::Press press, std::uint32_t player, peer::Session& session);

  std::uint64_t window_ = 0;
  std::map<std::uint32_t, Felt> felt_;  ///< by player
  std::vector<peer::Press> pressed_;
};

}  // namespace rink::game
