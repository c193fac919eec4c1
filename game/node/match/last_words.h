// What nodes that are left tell each other of those that are lost. docs/peer-to-peer.md, "Nodes".
#pragma once

#include <cstdint>
#include <vector>

#include "game/node/match/referee_log.h"
#include "game/peer/messages.h"

namespace rink::game {

/// A lost node's word of a round.
struct LostWord {
  peer::PeerNumber node = 0;
  std::uint64_t round = 0;  ///< counted over all sessions
  std::vector<std::uint8_t> bytes{};
};

/// Up to which round a lost node takes part.
struct LastRound {
  peer::PeerNumber node = 0;
  std::uint64_t round = 0;  ///< the first without it
};

/// Said by each to all once they agree on who is lost.
struct LastWords {
  std::uint64_t mark = 0x7473614c6b6e6952ULL;  ///< "RinkLast"
  std::uint64_t round = 0;                     ///< how many rounds this node has completed
  std::vector<peer::PeerNumber> gone{};        ///< all lost nodes
  std::vector<LostWord> words{};               ///< those that others may not have
  std::vector<LastRound> last_rounds{};        ///< of those of which this node knows it already
  RefereeWords referee{};                      ///< those that others may not have

  static constexpr std::size_t words_max = 256;
};

template <class Stream>
bool exchange(Stream& stream, LostWord& word) {
  return stream.numbers(word.node, word.round) && stream.number_list(word.bytes);
}

template <class Stream>
bool exchange(Stream& stream, LastRound& last) {
  return stream.numbers(last.node, last.round);
}

template <class Stream>
bool exchange(Stream& stream, LastWords& words) {
  return stream.number(words.mark) && words.mark == LastWords{}.mark &&
         stream.number(words.round) && stream.number_list(words.gone) &&
         peer::exchange_list(stream, words.words) && words.words.size() <= LastWords::words_max &&
         peer::exchange_list(stream, words.last_rounds) &&
         words.last_rounds.size() <= words.gone.size() && exchange(stream, words.referee);
}

}  // namespace rink::game
