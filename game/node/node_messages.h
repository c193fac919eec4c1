// What nodes say to each other beside their session. The last byte says what a message is, the two
// before it how often its sender had gone back after a loss.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "game/net/peer/network/session_network.h"

namespace rink::game {

enum class NodeMessage : std::uint8_t {
  change,
  wanted_cells,
  seat_wishes,
  seat_decisions,
  match_wish,
  match_news,
  keys,
  stand_in
};

inline constexpr std::size_t node_message_tail = 3;
/// Of a message that has a tail.
inline NodeMessage kind_of(std::span<const std::uint8_t> bytes) {
  return static_cast<NodeMessage>(bytes.back());
}
inline std::uint16_t recoveries_in(std::span<const std::uint8_t> bytes) {
  const std::size_t at = bytes.size() - node_message_tail;
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}
inline std::span<const std::uint8_t> content_of(std::span<const std::uint8_t> bytes) {
  return bytes.first(bytes.size() - node_message_tail);
}

/// What is said of bats or keys at once, in one message: a flood of messages is taken for a lie.
template <class Word>
struct ListOf {
  std::vector<Word> words;
};

template <class Stream, class Word>
bool exchange(Stream& stream, ListOf<Word>& list) {
  return stream.size(list.words) &&
         std::ranges::all_of(list.words, [&](Word& word) { return exchange(stream, word); });
}

inline void say(SessionNetwork& network, peer::PeerNumber to, NodeMessage kind,
                std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> bytes(content.size() + node_message_tail);
  std::ranges::copy(content, bytes.begin());
  bytes[content.size()] = static_cast<std::uint8_t>(network.recoveries & 0xff);
  bytes[content.size() + 1] = static_cast<std::uint8_t>(network.recoveries >> 8);
  bytes.back() = static_cast<std::uint8_t>(kind);
  network.send_aside(to, std::move(bytes));
}

inline void tell_others(SessionNetwork& network, NodeMessage kind,
                        std::span<const std::uint8_t> content) {
  for (peer::PeerNumber to = 0; to < network.terms().peer_count; ++to)
    if (to != network.number()) say(network, to, kind, content);
}

}  // namespace rink::game
