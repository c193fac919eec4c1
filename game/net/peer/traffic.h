// The purposes of peers' messages.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/protocol.h"

namespace rink::game {

/// `halo`: states that are handed over at a window's end. `claims`, `agreement`: the proof of a
/// window, and the verdicts on it. `interest`: players' views. `updates`: states of bodies beyond
/// the halo. `keys`: key presses on their way to the bat's owner, and how many have taken effect.
/// `standby`: records and snapshots for the peer that keeps a copy of the part.
enum class Traffic : std::uint8_t { halo, claims, agreement, interest, updates, keys, standby };
inline constexpr std::size_t traffic_count = 7;
inline constexpr std::array<const char*, traffic_count> traffic_names{
    "halo", "claims", "agreement", "interest", "updates", "keys", "standby"};

inline Traffic traffic_of(peer::Subject about) {
  switch (about) {
    case peer::Subject::claims:
      return Traffic::claims;
    case peer::Subject::verdict:
      return Traffic::agreement;
    case peer::Subject::handover:
      break;
  }
  return Traffic::halo;
}

/// `content` behind its purpose, as it is sent.
inline std::vector<std::uint8_t> with_purpose(Traffic about,
                                              std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> bytes(content.size() + 1);
  bytes[0] = static_cast<std::uint8_t>(about);
  std::ranges::copy(content, bytes.begin() + 1);
  return bytes;
}

using TrafficBytes = std::array<std::uint64_t, traffic_count>;

}  // namespace rink::game
