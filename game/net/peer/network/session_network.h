// How the members of a session reach each other, whatever carries it: sockets, or MPI.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "game/net/interrupt.h"
#include "game/net/peer/network/greetings.h"
#include "game/net/peer/network/side_channel.h"
#include "game/peer/protocol.h"
#include "rti/transport/transport.h"

namespace rink::game {

struct PeerNetworkSettings {
  PeerInfo self;  ///< the number of its bats, among so many; over sockets also where others reach
                  ///< this peer, which listens there already:
  std::uint32_t bats = 0;
  Fingerprint session_fingerprint;
  std::uint64_t session = 0;  ///< of a first peer: a number that cannot be guessed
  double patience_s = 30.0;   ///< timeout of a peer whose answer is due
  /// Why nobody may join while these play; empty: others may, where parts are replicated.
  std::function<std::string()> late_refusal{};
  double gathering_s =
      std::numeric_limits<double>::infinity();  ///< how long the first peers wait for each other
  std::function<bool()> must_end = [] {
    return is_interrupted != 0;
  };  ///< the user wants this peer's part to be over
};

/// The network of one member, whose number and terms are known. Calls that wait throw SessionError
/// when another is gone, interrupted or silent, or when a user interrupts this one.
class SessionNetwork : public peer::Mail, public SideChannel {
 public:
  virtual const Terms& terms() const = 0;
  virtual peer::PeerNumber number() const = 0;
  /// All members, by number, once they are gathered.
  virtual const std::vector<PeerInfo>& peer_infos() const = 0;

  /// Waits until all first members are connected. Throws SessionError if they do not come in time.
  virtual void gather() = 0;
  /// The game begins: from here on members may be lost, and others join, where the network can.
  virtual void begin() = 0;
  /// Call it before each window, to measure its length and the time that leaving takes.
  virtual void note_window() = 0;
  /// Only receives until `time_s` of the clock, or a user's interrupt.
  virtual void rest_until(double time_s) = 0;
  /// Keeps a side message that came too early.
  virtual void defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) = 0;
  /// What was sent to one member so far, with headers where the network knows them.
  virtual rti::TransportCounters sent_to(peer::PeerNumber member) const = 0;
  /// Sends a farewell to all, and waits until all bytes are sent.
  virtual void leave(const Farewell& farewell) = 0;
  /// For those that wait for something else than mail, where members can be lost: the next mail of
  /// `from`, if it has come, even if that member is gone. Never waits. Without mail it throws as
  /// receive() does if a member is gone, or `from` was silent for too long.
  virtual std::optional<std::vector<std::uint8_t>> next_mail(peer::PeerNumber /*from*/) {
    return std::nullopt;
  }
};

}  // namespace rink::game
