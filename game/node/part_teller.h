// Tells other nodes, after each window, what their clients may see of this one's part.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/node/cells.h"
#include "game/peer/peer.h"
#include "game/peer/session/part_change.h"

namespace rink::game {

/// Counts since the start, over all other nodes.
struct TellingCounters {
  std::uint64_t windows = 0;               ///< each counted once for each other node
  std::uint64_t bodies = 0, goodbyes = 0;  ///< states told, and bodies told of no more
  std::uint64_t bytes = 0;
  std::uint64_t last_bodies = 0, last_bytes = 0;  ///< with the last window, in none of the above
};

/// An owner sends a body, in its whole state, from when it comes into the receiver's cells until it
/// leaves them. If the body changes owners within them, the new one goes on. A new owner also says
/// when a body that comes to it lies in no cell of the receiver, to which the former owner may have
/// sent it.
class PartTeller {
 public:
  PartTeller(const physics::Field& field, std::uint32_t body_count, peer::PeerNumber node_count,
             peer::PeerNumber own);

  /// A player of node `to` moves this bat, from now on if others play; so that node receives the
  /// bat wherever it is.
  void seat(peer::PeerNumber to, std::uint32_t bat);
  /// Until it says what it wants, a node wants everything. False for what cannot be, or comes when
  /// no node says it.
  bool follow(peer::PeerNumber from, const WantedCells& wanted);

  /// Before the first window, when all know the bodies of the start.
  void begin(const peer::Peer& peer);
  /// All nodes go back to the end of that window. The next change tells each of the others anew
  /// which bodies it receives, and which it does not receive any more.
  void begin_again(const peer::Peer& peer, std::uint64_t window);
  /// `change` is that of the own part in the window that leads to its step; with the last one all
  /// are told of everything.
  void look(const peer::Peer& peer, const peer::PartChange& change, bool is_last);
  /// What node `to` receives of that change. Call it between `look` and the next one, once for each
  /// node. The bytes are valid until the next call.
  std::span<const std::uint8_t> bytes_for(peer::PeerNumber to, const peer::Peer& peer,
                                          const peer::PartChange& change);

  const TellingCounters& counters() const { return counters_; }

 private:
  struct Listener {
    Cells cells;
    std::optional<std::pair<std::uint64_t, Cells>> coming;  ///< from that step on
    std::vector<std::uint32_t> always;                      ///< bodies, by number
    std::vector<bool> is_told;  ///< by body: of the own ones, those of which it knows all
    bool is_anew = false;       ///< it may have bodies, told before a loss, that it does not want
  };
  struct Own {
    enum class Change : std::uint8_t { none, free_flight, whole };
    std::uint32_t body = 0;
    bool has_come = false;         ///< in this window
    Change change = Change::none;  ///< in this window
    physics::Vector2 position{0.0, 0.0};
  };

  void forget_left(const peer::Peer& peer);
  void take_own(const peer::Peer& peer, const peer::PartChange& change);
  bool is_wanted(const Listener& to, const Own& own) const;
  void count(const peer::PartChange& told);
  peer::PartChange part_for(Listener& to, const peer::Peer& peer, const peer::PartChange& change);

  physics::Field field_;
  peer::PeerNumber number_;
  std::vector<Listener> listeners_;  ///< by node
  std::vector<Own> own_;             ///< after the last window; no posts, which all have
  std::vector<bool> was_own_;        ///< by body: then
  std::uint64_t step_ = 0;           ///< that was told of last
  bool is_last_ = false;
  std::vector<std::uint8_t> whole_, bytes_;  ///< of the change, once it was needed; and of a part
  TellingCounters counters_;
};

}  // namespace rink::game
