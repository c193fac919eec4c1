// One peer's side of a simulation over anything that carries bytes.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "game/peer/peer.h"

namespace rink::peer {

/// What one peer has to each of the others: bytes go whole and in order.
class Mail {
 public:
  virtual ~Mail() = default;
  virtual void send(PeerNumber to, std::vector<std::uint8_t> bytes) = 0;
  /// The next message of `from`; waits for it. Throws what its maker chooses if there will be none.
  virtual std::vector<std::uint8_t> receive(PeerNumber from) = 0;
  /// What each of `peer_count` says to all, by number, when all call it with equally many bytes at the same point of the protocol: by send and receive, unless whoever carries
  /// the mail has a shorter way.
  virtual std::vector<std::vector<std::uint8_t>> share(PeerNumber own, PeerNumber peer_count, std::vector<std::uint8_t> bytes);
};

/// Another peer said what cannot be.
class ProtocolError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Plays the window that `begin` or the last call has prepared, and prepares the next, which ends at `next` [s]. All peers must do the same. Throws ProtocolError.
void play_window(Peer& peer, PeerNumber peer_count, Mail& mail, double next);

/// At the end of everybody's last window: the states of the peer's own bodies.
Arrivals own_bodies(const Peer& peer);

/// The hash (World::hash) of the whole of `body_count` bodies, of which each of `parts` has some; nothing unless each body is in one of them.
std::optional<std::uint64_t> hash_of_whole(const physics::WorldSpec& spec, std::uint32_t body_count, std::span<const Arrivals> parts);

/// The hash of a little world that has a bit of everything: builds that differ in it would part in a simulation.
std::uint64_t self_test_hash();

}  // namespace rink::peer
