// The way of verdicts up and down a tree of the members, where from each to each they would be many
// messages. docs/peer-to-peer.md, "Agreement".
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/messages.h"

namespace rink::peer {

/// Verdicts of one or more members on one window.
struct VerdictBundle {
  static constexpr std::size_t verdicts_max = 64;  ///< a session has no more members
  bool is_decision = false;  ///< everybody's, on its way down; otherwise those of a branch
  std::uint32_t window = 0;
  std::vector<Verdict> verdicts{};  ///< by their senders' places in the tree
};

/// Places of members in the order of their numbers. Place 0 is the root; all have the same number
/// of children, the least from 4 on that reaches all in two levels, so an agreement takes at most
/// four one-way delays.
class VerdictTree {
 public:
  explicit VerdictTree(std::size_t count) : count_(count) {
    assert(count > 0);
    while (1 + degree_ + degree_ * degree_ < count) ++degree_;
  }

  std::size_t degree() const { return degree_; }
  /// Of a place that is not the root.
  std::size_t parent(std::size_t place) const {
    assert(place > 0 && place < count_);
    return (place - 1) / degree_;
  }
  std::vector<std::size_t> children(std::size_t place) const;
  /// The place and all below it, sorted.
  std::vector<std::size_t> branch(std::size_t place) const;
  /// How many links the last place is away from the root.
  std::size_t depth() const;

 private:
  std::size_t count_, degree_ = 4;
};

template <class Stream>
bool exchange(Stream& stream, VerdictBundle& message) {
  Head head({message.is_decision});
  if (!head.exchange(stream) || !stream.varint(message.window)) return false;
  message.is_decision = head.has(0);
  std::uint64_t count = message.verdicts.size();
  if (!stream.varint(count) || count == 0 || count > VerdictBundle::verdicts_max) return false;
  if constexpr (Stream::is_reading) message.verdicts.resize(static_cast<std::size_t>(count));
  for (Verdict& verdict : message.verdicts) {
    if (!exchange(stream, verdict, false)) return false;
    if constexpr (Stream::is_reading) verdict.window = message.window;
  }
  return true;
}

/// With a checksum of four bytes at the end.
std::vector<std::uint8_t> written(VerdictBundle message);
bool read(std::span<const std::uint8_t> bytes, VerdictBundle& message);

}  // namespace rink::peer
