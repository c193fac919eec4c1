// What a peer knows of one of its connections, and of who is at the other end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "game/net/peer/network/frames.h"
#include "game/net/peer/network/greetings.h"
#include "game/peer/protocol.h"

namespace rink::game {

/// A caller has asked to join during the game. A dismissed connection is read no more; either end
/// closes it.
enum class LinkRole : std::uint8_t { stranger, asked, caller, peer, dismissed };

struct PeerLink {
  // Who is there.
  LinkRole role = LinkRole::stranger;
  peer::PeerNumber number = 0;
  PeerInfo info;

  // The connection, kept by PeerLinks.
  bool is_open = false, is_closed = false;
  double since_s = 0.0, received_s = 0.0, sent_s = 0.0;
  FrameQueue frames;
  std::deque<std::vector<std::byte>> outbox;
  std::size_t out_begin = 0;  ///< bytes sent of the first message in the outbox

  // Of who asks for admission, kept by PeerAdmission.
  std::optional<Greeting> early;  ///< came before the own number was known
  std::optional<Hello> asking;    ///< came before the own number was known, too
  bool is_announced = false;      ///< of a caller: by `callers`
  bool is_counted = true;         ///< of a peer: its loss matters; that of a candidate does not

  // Of a peer, kept by PeerConversation and PeerLosses.
  std::deque<std::vector<std::uint8_t>> inbox;
  bool is_done = false;          ///< it has sent its farewell
  bool was_interrupted = false;  ///< which has said so
  bool is_parted = false;
  std::string loss;  ///< why it is gone, if it is
};

inline std::string name_of(const PeerLink& link) {
  return "peer " + std::to_string(link.number) + " (" + link.info.place.text() + ")";
}

}  // namespace rink::game
