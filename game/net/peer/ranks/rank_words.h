// What ranks of MPI tell each other before they play, so that all know whether they can play
// together, and who plays which bats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "game/net/peer/network/greetings.h"

namespace rink::game {

/// A rank's first data to all others. What follows `version` is of that version; all versions use
/// `rank_words` bytes.
struct RankWords {
  std::array<std::uint8_t, 8> magic{'R', 'i', 'n', 'k', 'R', 'a', 'n', 'k'};
  std::uint32_t version = peer_protocol_version;
  Fingerprint session_fingerprint;
  double until = 0.0, window = 0.0;  ///< s
  std::uint32_t balance_windows = 0;
  PeerInfo info;  ///< without a place; ranks get bats in their order
  bool is_of_this_version() const { return version == peer_protocol_version; }
};
inline constexpr std::size_t rank_words = 128;  ///< bytes: the length (1), the data, zeros

template <class Stream>
bool exchange(Stream& stream, RankWords& words) {
  for (std::uint8_t& byte : words.magic)
    if (!stream.number(byte)) return false;
  if (words.magic != RankWords().magic || !stream.number(words.version)) return false;
  Fingerprint& session_fingerprint = words.session_fingerprint;
  return !words.is_of_this_version() ||
         (stream.numbers(session_fingerprint.self_test, session_fingerprint.scene,
                         session_fingerprint.keys, words.until, words.window,
                         words.balance_windows) &&
          exchange(stream, words.info));
}

/// A refused rank, and the reason.
struct RefusedRank {
  std::uint32_t number = 0;
  RefusalKind kind = RefusalKind::other;
  std::string reason;
};

std::vector<std::uint8_t> spoken(const RankWords& words);
/// Bytes in a place of `rank_words`, as a collective carries them, and out of it; fewer than
/// `rank_words` (asserted).
std::vector<std::uint8_t> in_its_place(std::span<const std::uint8_t> content);
std::span<const std::uint8_t> out_of_its_place(std::span<const std::uint8_t> place);

/// The ranks that cannot play with the first one, by the data of all, one after the other; `bats`
/// can be played.
std::vector<RefusedRank> refused_ranks(
    std::span<const std::uint8_t> all,
    std::uint32_t bats = std::numeric_limits<std::uint32_t>::max());
/// Who plays which bats, if none is refused (asserted).
std::vector<PeerInfo> seated_ranks(std::span<const std::uint8_t> all);

}  // namespace rink::game
