// The peers that may continue, and a newcomer's entry.
#include "game/peer/session/session_state.h"

#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <tuple>

#include "game/peer/message_bytes.h"

namespace rink::peer {

std::vector<std::uint8_t> written(Entry message) { return bytes_from(message); }
bool read(std::span<const std::uint8_t> bytes, Entry& message) {
  return read_whole(bytes, message);
}

void State::check() const {
  const std::vector<PeerNumber> zoned = cuts.peers();
  for ([[maybe_unused]] const std::vector<PeerNumber>* list : {&members, &fresh, &gone, &zoned})
    assert(std::ranges::adjacent_find(*list, std::greater_equal<>()) == list->end() &&
           (list->empty() || list->back() < next_number));
  assert(!members.empty() && members.back() < slots && slots <= next_number);
  assert(std::ranges::includes(members, fresh) && std::ranges::includes(members, zoned));
  assert(events.size() <= slots);
  assert(std::ranges::none_of(gone, [this](PeerNumber peer) { return has(peer); }));
  for ([[maybe_unused]] const Candidate& candidate : candidates)
    assert(candidate.number < next_number && !has(candidate.number));
  for ([[maybe_unused]] const Player& player : players) assert(player.peer < next_number);
  assert(std::isfinite(time) && time >= 0.0 && scoring.next() > time);
  scoring.check();
}

std::vector<PeerNumber> State::voters() const {
  std::vector<PeerNumber> all;
  std::set_difference(members.begin(), members.end(), fresh.begin(), fresh.end(),
                      std::back_inserter(all));
  return all;
}

/// A peer without a zone leaves with the next step; a fresh one gets a zone then.
std::vector<PeerNumber> State::next_voters() const {
  std::vector<PeerNumber> all = members;
  const std::vector<PeerNumber> zoned = cuts.peers();
  std::erase_if(all, [&](PeerNumber peer) { return !is_in(zoned, peer) && !is_fresh(peer); });
  return all;
}

bool State::is_sound_for(PeerNumber newcomer) const {
  const auto is_list = [&](const std::vector<PeerNumber>& list) {
    return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end() &&
           (list.empty() || list.back() < next_number);
  };
  const std::vector<PeerNumber> zoned = cuts.peers();
  const auto holds_all = [](const std::vector<PeerNumber>& all,
                            const std::vector<PeerNumber>& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
  };
  const bool has_lists = is_list(members) && is_list(fresh) && is_list(gone) && is_list(zoned);
  if (!has_lists || next_number > numbers_max || slots > next_number ||
      members.size() > members_max)
    return false;
  const auto is_due = [&](const FaceOff& due) {
    return std::isfinite(due.time) && due.time > time;
  };
  if (!std::isfinite(time) || time < 0.0 ||
      !std::all_of(scoring.face_offs.begin(), scoring.face_offs.end(), is_due) ||
      !std::ranges::is_sorted(scoring.face_offs, {},
                              [](const FaceOff& due) { return std::tuple(due.time, due.puck); }) ||
      (scoring.is_over && !scoring.face_offs.empty()))
    return false;
  return !members.empty() && members.back() < slots && holds_all(members, fresh) &&
         holds_all(members, zoned) &&
         !std::ranges::any_of(gone, [&](PeerNumber peer) { return has(peer); }) &&
         is_fresh(newcomer) && !is_in(zoned, newcomer) && !is_in(gone, newcomer) &&
         events.size() <= slots &&
         std::all_of(events.begin(), events.end(),
                     [](double count) { return std::isfinite(count) && count >= 0.0; }) &&
         std::all_of(candidates.begin(), candidates.end(),
                     [&](const Candidate& candidate) {
                       return candidate.number < next_number && !has(candidate.number);
                     }) &&
         std::all_of(players.begin(), players.end(),
                     [&](const Player& player) { return player.peer < next_number; });
}

}  // namespace rink::peer
