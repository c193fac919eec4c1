// What nodes say to each other beside their session: what a message is, is its last byte.
#pragma once

#include <algorithm>
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
  keys
};

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
  std::vector<std::uint8_t> bytes;
  bytes.reserve(content.size() + 1);
  bytes.assign(content.begin(), content.end());
  bytes.push_back(static_cast<std::uint8_t>(kind));
  network.send_aside(to, std::move(bytes));
}

inline void tell_others(SessionNetwork& network, NodeMessage kind,
                        std::span<const std::uint8_t> content) {
  for (peer::PeerNumber to = 0; to < network.terms().peer_count; ++to)
    if (to != network.number()) say(network, to, kind, content);
}

}  // namespace rink::game
