// What all peers of a session agree on at a step: who plays, where zones are, and who is about to
// come.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/cuts.h"
#include "game/peer/messages.h"
#include "game/peer/session/scoring.h"

namespace rink::peer {

/// No session ever gives more numbers, and none has more peers at a time.
inline constexpr PeerNumber numbers_max = 4096, members_max = 64;

/// Somebody who has a number, and is no member until all are connected to it.
struct Candidate {
  PeerNumber number = 0, sponsor = 0;
  std::uint32_t first_bat = 0;
  Newcomer newcomer;
};

/// Who plays which of the scene's bats: `bat_count` from `first_bat` on, each of which looks at
/// `puck_count` pucks, and the first `hand_count` by hand.
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
  std::vector<PeerNumber> members{};  ///< those who leave among them
  Cuts cuts;
  std::uint64_t zones = 0;            ///< how often they changed
  std::uint32_t counted_windows = 0;  ///< in which the events are counted, by peer
  std::vector<double> events{};
  std::vector<PeerNumber> fresh{};                  ///< members who have had no zone yet
  std::vector<PeerNumber> gone{};                   ///< who was lost
  std::vector<Candidate> candidates{}, admitted{};  ///< by number; and those who became members
  std::vector<Player> players{};
  PeerNumber slots = 1, next_number = 1;  ///< above all numbers of members; the next newcomer's
  std::uint32_t bats_taken = 0;

  static bool is_in(const std::vector<PeerNumber>& sorted, PeerNumber peer) {
    return std::binary_search(sorted.begin(), sorted.end(), peer);
  }
  bool has(PeerNumber peer) const { return is_in(members, peer); }
  bool is_fresh(PeerNumber peer) const { return is_in(fresh, peer); }
  /// Those whose majority may go on from here, and from the next step.
  std::vector<PeerNumber> voters() const;
  std::vector<PeerNumber> next_voters() const;
  Division division() const { return cuts.division(slots); }
  /// Whether a stranger's state can be one, with `newcomer` as a member of it.
  bool is_sound_for(PeerNumber newcomer) const;
  /// Asserts that lists of numbers are sorted, and each number one that was given, that zones and
  /// what is new belong to members, and that what is due is still to come.
  void check() const;
};

/// Tells an Entry from all other messages: "RnkEntry".
inline constexpr std::uint64_t entry_word = 0x7972746e456b6e52ULL;

/// To a newcomer, of each member: how things are at the step with which it becomes one.
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
         exchange_numbers(stream, state.members) && state.cuts.exchange(stream) &&
         stream.numbers(state.zones, state.counted_windows) && stream.size(state.events) &&
         std::all_of(state.events.begin(), state.events.end(),
                     [&](double& events) { return stream.number(events); }) &&
         exchange_numbers(stream, state.fresh) && exchange_numbers(stream, state.gone) &&
         exchange_list(stream, state.candidates) && exchange_list(stream, state.admitted) &&
         exchange_list(stream, state.players) &&
         stream.numbers(state.slots, state.next_number, state.bats_taken);
}
std::vector<std::uint8_t> written(Entry message);
/// The cuts of `message` must be of the right field.
bool read(std::span<const std::uint8_t> bytes, Entry& message);

}  // namespace rink::peer
