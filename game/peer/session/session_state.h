// The state that all peers of a session share at a step: members, zones, and candidates.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/cuts.h"
#include "game/peer/messages.h"
#include "game/peer/session/scoring.h"

namespace rink::peer {

/// A session assigns at most `numbers_max` numbers, and has at most `members_max` peers at a time.
inline constexpr PeerNumber numbers_max = 4096, members_max = 64;

/// A peer with a number that is no member until all are connected to it.
struct Candidate {
  PeerNumber number = 0, sponsor = 0;
  std::uint32_t first_bat = 0;
  Newcomer newcomer;
};

/// A player's bats: `bat_count` from `first_bat` on, each of which looks at `puck_count` pucks;
/// persons play the first `hand_count`.
struct Player {
  PeerNumber peer = 0;
  std::uint32_t first_bat = 0, bat_count = 0, puck_count = 0, hand_count = 0;
};

/// Lists of numbers are sorted.
struct State {
  std::uint64_t step = 0, window = 0;
  double time =
      0.0;  ///< where it ends [s], which is within the next window while a puck comes back
  Scoring scoring{};
  std::vector<PeerNumber> members{};  ///< with those that leave
  Cuts cuts;
  std::uint64_t zones = 0;            ///< how often they changed
  std::uint32_t counted_windows = 0;  ///< in which the events are counted, by peer
  std::vector<double> events{};
  std::vector<PeerNumber> fresh{};                  ///< members without a zone so far
  std::vector<PeerNumber> gone{};                   ///< lost peers
  std::vector<Candidate> candidates{}, admitted{};  ///< by number; and those that became members
  std::vector<Player> players{};
  PeerNumber slots = 1, next_number = 1;  ///< above all numbers of members; the next newcomer's
  std::uint32_t bats_taken = 0;

  static bool is_in(const std::vector<PeerNumber>& sorted, PeerNumber peer) {
    return std::binary_search(sorted.begin(), sorted.end(), peer);
  }
  bool has(PeerNumber peer) const { return is_in(members, peer); }
  bool is_fresh(PeerNumber peer) const { return is_in(fresh, peer); }
  /// The peers whose majority may continue from here, and from the next step.
  std::vector<PeerNumber> voters() const;
  std::vector<PeerNumber> next_voters() const;
  Division division() const { return cuts.division(slots); }
  /// True if a received state is possible, with `newcomer` as a member.
  bool is_sound_for(PeerNumber newcomer) const;
  /// Asserts that lists of numbers are sorted and assigned, that zones and fresh entries belong to
  /// members, and that due pucks are in the future.
  void check() const;
};

/// Marks an Entry: "RnkEntry".
inline constexpr std::uint64_t entry_word = 0x7972746e456b6e52ULL;

/// The state that each member sends to a newcomer, at the step with which it becomes a member.
struct Entry {
  std::uint64_t word = entry_word;
  State state;
};

template <class Stream>
bool exchange(Stream& stream, Candidate& candidate) {
  return stream.numbers(candidate.number, candidate.sponsor, candidate.first_bat) &&
         exchange(stream, candidate.newcomer);
}

template <class Stream>
bool exchange(Stream& stream, Player& player) {
  return stream.numbers(player.peer, player.first_bat, player.bat_count, player.puck_count,
                        player.hand_count);
}

template <class Stream>
bool exchange(Stream& stream, FaceOff& due) {
  return stream.numbers(due.time, due.puck) && stream.truth(due.is_left);
}

template <class Stream>
bool exchange(Stream& stream, Scoring& scoring) {
  return stream.numbers(scoring.left, scoring.right) && stream.truth(scoring.is_over) &&
         exchange_list(stream, scoring.face_offs);
}

template <class Stream>
bool exchange(Stream& stream, Entry& entry) {
  State& state = entry.state;
  return stream.number(entry.word) && entry.word == entry_word &&
         stream.numbers(state.step, state.window, state.time) && exchange(stream, state.scoring) &&
         stream.number_list(state.members) && state.cuts.exchange(stream) &&
         stream.numbers(state.zones, state.counted_windows) && stream.number_list(state.events) &&
         stream.number_list(state.fresh) && stream.number_list(state.gone) &&
         exchange_list(stream, state.candidates) && exchange_list(stream, state.admitted) &&
         exchange_list(stream, state.players) &&
         stream.numbers(state.slots, state.next_number, state.bats_taken);
}
std::vector<std::uint8_t> written(Entry message);
/// The cuts of `message` must be of the right field.
bool read(std::span<const std::uint8_t> bytes, Entry& message);

}  // namespace rink::peer
