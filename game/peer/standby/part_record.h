// What a peer tells its standby: a record of each step, and now and then a snapshot in pieces.
// docs/peer-to-peer.md, "Standby copies".
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/messages.h"

namespace rink::peer {

/// What came to a part from outside between two runs, or went.
struct PartInput {
  std::vector<std::uint32_t> dropped{};  ///< bodies that are not there any more, by number
  std::vector<std::uint8_t> states{};    ///< bodies that are there from now on, or in another state
                                         ///< (packed_states.h)
  std::vector<std::uint32_t> known{};    ///< others that are, which the keeper has itself in that
                                         ///< state (known_bodies.h); by number
  bool sets_contacts = false;  ///< if not, contacts are as they were, without those of bodies that
                               ///< are gone
  std::vector<RestContact> rest_contacts{};  ///< all of them

  bool is_empty() const {
    return dropped.empty() && states.empty() && known.empty() && !sets_contacts;
  }
};

/// All that a run of a part depends on beside its state before. A step's run may follow from more
/// ghosts than were there at first (`repeated`); `committed` comes at its end.
struct PartRecord {
  std::uint64_t step = 0;  ///< that it leads to
  PartInput repeated{};
  std::vector<Key> own_keys{};    ///< of live players on own bats, that took effect
  std::vector<Key> other_keys{};  ///< all other keys that did, of ghosts and those that all know
  PartInput committed{};
  std::vector<Key> pending{};     ///< of live players on own bats, that are still to take effect
  std::vector<Key> inherited{};   ///< of who has left, for the log alone
  std::uint32_t piece_count = 0;  ///< of a snapshot, that follow at once

  // What follows is not sent: the receiver knows the time.
  double time = 0.0;       ///< of the step [s]
  std::uint64_t work = 0;  ///< of the run, in events of straight flights, which take 1 to 3 us:
                           ///< with drag one counts twice, and each body on another curve once more
};

/// The whole of a part at a step: own bodies and ghosts.
struct PartSnapshot {
  std::vector<std::uint8_t> states{};
  std::vector<RestContact> rest_contacts{};
  std::vector<Key> pending{};
  bool is_first = false;   ///< for who has nothing of this part yet
  std::vector<Key> log{};  ///< then: the log since the start
};

/// A snapshot's bytes from `offset` on.
struct SnapshotPiece {
  static constexpr std::size_t bytes_max = 1 << 20;
  /// A snapshot's, as of a peer's frame; so as many pieces are far more than there ever are.
  static constexpr std::uint64_t total_max = std::uint64_t{1} << 30;
  static constexpr std::uint32_t count_max = 1 << 14;
  std::uint64_t step = 0;  ///< of the snapshot
  std::uint64_t total = 0, offset = 0;
  std::vector<std::uint8_t> bytes{};
};

template <class Stream>
bool exchange(Stream& stream, PartInput& input) {
  Head head({!input.dropped.empty(), !input.states.empty(), input.sets_contacts,
             !input.rest_contacts.empty(), !input.known.empty()});
  if (!head.exchange(stream)) return false;
  input.sets_contacts = head.has(2);
  return exchange_numbers(stream, head.has(0), input.dropped) &&
         exchange_part(stream, head.has(1), input.states) &&
         exchange_part(stream, head.has(3), input.rest_contacts) &&
         exchange_numbers(stream, head.has(4), input.known);
}

template <class Stream>
bool exchange_if(Stream& stream, bool is_there, PartInput& input) {
  if (!is_there) return input = {}, true;
  return exchange(stream, input);
}

/// The seventh part of the head is always there.
template <class Stream>
bool exchange(Stream& stream, PartRecord& record) {
  Head head({!record.repeated.is_empty(), !record.committed.is_empty(),
             !record.own_keys.empty() || !record.other_keys.empty(), !record.pending.empty(),
             !record.inherited.empty(), record.piece_count > 0, true});
  if (!head.exchange(stream) || !head.has(6) || !stream.varint(record.step)) return false;
  if (!exchange_if(stream, head.has(0), record.repeated) ||
      !exchange_if(stream, head.has(1), record.committed))
    return false;
  if (!head.has(2)) record.own_keys.clear(), record.other_keys.clear();
  else if (!exchange_list(stream, record.own_keys) || !exchange_list(stream, record.other_keys))
    return false;
  if (!exchange_part(stream, head.has(3), record.pending) ||
      !exchange_part(stream, head.has(4), record.inherited))
    return false;
  if (!head.has(5)) return record.piece_count = 0, true;
  return stream.varint(record.piece_count) && record.piece_count > 0 &&
         record.piece_count <= SnapshotPiece::count_max;
}

template <class Stream>
bool exchange(Stream& stream, PartSnapshot& snapshot) {
  return stream.number_list(snapshot.states) && exchange_list(stream, snapshot.rest_contacts) &&
         exchange_list(stream, snapshot.pending) && stream.truth(snapshot.is_first) &&
         exchange_list(stream, snapshot.log);
}

template <class Stream>
bool exchange(Stream& stream, SnapshotPiece& piece) {
  Head head({false, false, false, false, false, false, true});
  if (!head.exchange(stream) || !head.has(6)) return false;
  for (int other = 0; other < 6; ++other)
    if (head.has(other)) return false;
  return stream.varint(piece.step) && stream.varint(piece.total) && stream.varint(piece.offset) &&
         exchange_part(stream, true, piece.bytes) && piece.total <= SnapshotPiece::total_max &&
         piece.bytes.size() <= SnapshotPiece::bytes_max && piece.offset <= piece.total &&
         piece.bytes.size() <= piece.total - piece.offset;
}

std::vector<std::uint8_t> written(PartRecord message);
std::vector<std::uint8_t> written(PartSnapshot message);
std::vector<std::uint8_t> written(SnapshotPiece message);
bool read(std::span<const std::uint8_t> bytes, PartRecord& message);
bool read(std::span<const std::uint8_t> bytes, PartSnapshot& message);
bool read(std::span<const std::uint8_t> bytes, SnapshotPiece& message);

}  // namespace rink::peer
