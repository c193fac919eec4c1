// The messages between peers before and after they play (docs/peer-to-peer.md, "Joining"), as plain
// values with one function each that writes and reads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/net/relevant_kinds.h"
#include "game/peer/message_bytes.h"
#include "game/peer/session/session_state.h"

namespace rink::game {

inline constexpr std::uint32_t peer_protocol_version = 14;
inline constexpr std::uint32_t peers_max = 64;
/// The period [windows] in which zones shift toward equal load, unless a user sets another.
inline constexpr std::uint32_t balance_windows_default = 25;

/// The first byte of every frame.
enum class FrameKind : std::uint8_t {
  hello,
  welcome,
  elsewhere,
  refusal,
  greeting,
  mail,
  farewell,
  sign,
  aside
};
inline constexpr FrameKind frame_kind_max = FrameKind::aside;

/// Where a peer can be reached by all others.
struct Place {
  std::string address;
  std::uint16_t port = 0;
  std::string text() const {
    return (address.find(':') == std::string::npos ? address : "[" + address + "]") + ":" +
           std::to_string(port);
  }
};

/// One of the peers and its bats: `bat_count` from `first_bat` on, each of which looks at
/// `puck_count` pucks. Persons play the first `hand_count` of them, and look at every window's end.
/// `token` is a number of its own choice, unique to it.
struct PeerInfo {
  Place place;
  std::uint32_t first_bat = 0, bat_count = 0, puck_count = 0, hand_count = 0;
  std::uint64_t token = 0;
};

/// Data that must be equal at all peers.
struct Fingerprint {
  std::uint64_t self_test = 0;  ///< peer::self_test_hash()
  std::uint64_t scene = 0;      ///< game::fingerprint
  std::uint64_t keys = 0;       ///< of all keys, scripted and recorded
};

/// The terms of interest beyond the peers' own parts (SharedInterest); without a scheme there are
/// no updates.
struct InterestTerms {
  std::string scheme, policy = "on-event";
  double cell_size = 0.0;  ///< m; 0 lets the scheme choose
  std::uint8_t always =
      0;  ///< kinds of bodies that the scheme `always` lets through: RelevantKinds::bits
  bool is_wanted() const { return !scheme.empty(); }
  bool fit() const {
    return cell_size >= 0.0 && cell_size <= 1e6 && always <= RelevantKinds::bits_max;
  }
};

/// The terms that the first peer sets for all.
struct Terms {
  std::uint32_t peer_count = 2;
  double until = 0.0, window = 0.0;   ///< s
  std::uint32_t balance_windows = 0;  ///< period [windows] in which zones shift toward equal load;
                                      ///< 0: they stay
  bool is_replicated = true;          ///< whether each peer's part is kept by another, too
  bool is_seated = false;  ///< each peer has the player in its zone, whose keys all know, and zones
                           ///< are cut around players (seated_division)
  bool starts_together = false;  ///< at an instant that the first peer sends (start_together)
  InterestTerms interest{};
  bool fit() const {
    return peer_count >= 1 && peer_count <= peers_max && until > 0.0 && until <= 1e9 &&
           window > 0.0 && until / window <= 1e9 && interest.fit();
  }
};

/// A newcomer's first message, to any peer. What follows `version` is of that version.
struct Hello {
  std::array<std::uint8_t, 8> magic{'R', 'i', 'n', 'k', 'P', 'e', 'e', 'r'};
  std::uint32_t version = peer_protocol_version;
  Fingerprint session_fingerprint;
  PeerInfo info;  ///< the first peer assigns its bats
  bool is_of_this_version() const { return version == peer_protocol_version; }
};

/// A peer that a newcomer connects to: a member, or about to be one.
struct Introduced {
  std::uint32_t number = 0;
  bool is_member = true;
  PeerInfo info;
};

/// The answer of `sponsor`, which is the first peer before the game and any peer during it: the
/// newcomer is `number`, and plays bats from `first_bat` on.
struct Welcome {
  std::uint64_t session = 0;
  Terms terms;
  std::uint32_t sponsor = 0, number = 0, first_bat = 0;
  bool is_playing = false;
  std::vector<Introduced> others;
};

/// The answer of any other peer before the game: the place of the first peer, to ask.
struct Elsewhere {
  Place first;
};

enum class RefusalKind : std::uint8_t { wrong_version, other, again };

/// Of what others give as their reason, in messages [bytes].
inline constexpr std::size_t reason_shown_max = 500;

struct Refused {
  RefusalKind kind = RefusalKind::other;
  std::string reason;
};

/// A newcomer's message to each earlier peer but the first.
struct Greeting {
  std::uint64_t session = 0;
  std::uint32_t number = 0;
  PeerInfo info;
};

enum class FarewellKind : std::uint8_t { done, interrupted, trouble };

/// A peer's last message.
struct Farewell {
  FarewellKind kind = FarewellKind::done;
  std::string reason;
};

template <class Stream>
bool exchange(Stream& stream, std::string& text) {
  return stream.number_list(text);
}

template <class Stream>
bool exchange(Stream& stream, Place& place) {
  return exchange(stream, place.address) && stream.number(place.port);
}

template <class Stream>
bool exchange(Stream& stream, PeerInfo& info) {
  return exchange(stream, info.place) &&
         stream.numbers(info.first_bat, info.bat_count, info.puck_count, info.hand_count,
                        info.token) &&
         info.hand_count <= info.bat_count;
}

template <class Stream>
bool exchange(Stream& stream, Hello& hello) {
  for (std::uint8_t& byte : hello.magic)
    if (!stream.number(byte)) return false;
  if (hello.magic != Hello().magic || !stream.number(hello.version)) return false;
  Fingerprint& session_fingerprint = hello.session_fingerprint;
  return !hello.is_of_this_version() ||
         (stream.numbers(session_fingerprint.self_test, session_fingerprint.scene,
                         session_fingerprint.keys) &&
          exchange(stream, hello.info));
}

template <class Stream>
bool exchange(Stream& stream, Welcome& welcome) {
  Terms& terms = welcome.terms;
  InterestTerms& interest = terms.interest;
  const bool is_headed = stream.numbers(welcome.session, terms.peer_count, terms.until,
                                        terms.window, terms.balance_windows, welcome.sponsor,
                                        welcome.number, welcome.first_bat, interest.cell_size) &&
                         stream.truth(terms.is_replicated) && stream.truth(terms.is_seated) &&
                         stream.truth(terms.starts_together) && stream.truth(welcome.is_playing) &&
                         exchange(stream, interest.scheme) && exchange(stream, interest.policy) &&
                         stream.number(interest.always);
  if (!is_headed || !stream.size(welcome.others)) return false;
  bool has_sponsor = false;
  std::uint32_t least = 0;
  for (Introduced& one : welcome.others) {
    if (!stream.number(one.number) || !stream.truth(one.is_member) || !exchange(stream, one.info) ||
        one.number < least || one.number >= peer::numbers_max)
      return false;
    least = one.number + 1;
    has_sponsor = has_sponsor || one.number == welcome.sponsor;
    if (one.number == welcome.number) return false;
  }
  return terms.fit() && has_sponsor && welcome.number < peer::numbers_max &&
         (welcome.is_playing ? terms.is_replicated
                             : welcome.sponsor == 0 && welcome.number == welcome.others.size() &&
                                   welcome.number < terms.peer_count && least == welcome.number);
}

template <class Stream>
bool exchange(Stream& stream, Elsewhere& elsewhere) {
  return exchange(stream, elsewhere.first);
}

template <class Stream>
bool exchange(Stream& stream, Refused& refused) {
  return stream.choice(refused.kind, RefusalKind::again) && exchange(stream, refused.reason);
}

template <class Stream>
bool exchange(Stream& stream, Greeting& greeting) {
  return stream.numbers(greeting.session, greeting.number) && exchange(stream, greeting.info);
}

template <class Stream>
bool exchange(Stream& stream, Farewell& farewell) {
  return stream.choice(farewell.kind, FarewellKind::trouble) && exchange(stream, farewell.reason);
}

/// With a checksum at the end.
template <class Message>
std::vector<std::uint8_t> bytes_of(Message message) {
  return peer::bytes_from(message);
}

/// Nothing unless the bytes are one whole message. Of a Hello of another version only the version
/// is read.
template <class Message>
std::optional<Message> message_from(std::span<const std::uint8_t> bytes) {
  std::optional<Message> message(std::in_place);
  if (!peer::read_whole(bytes, *message)) message.reset();
  return message;
}

}  // namespace rink::game
