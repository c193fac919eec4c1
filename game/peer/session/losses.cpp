// Adds losses in order, and counts who is left.
#include "game/peer/session/losses.h"

#include <cassert>
#include <functional>
#include <utility>

namespace rink::peer {

bool Losses::note(PeerNumber peer, const std::string& what, bool has_finished) {
  if (has_finished && !State::is_in(finished_, peer))
    finished_.insert(std::ranges::upper_bound(finished_, peer), peer);
  if (is_gone(peer)) return false;
  last_ = what;
  gone_.insert(std::ranges::upper_bound(gone_, peer), peer);
  return true;
}

void Losses::begin(const State& now) {
  std::erase_if(gone_, [&](PeerNumber peer) { return !now.has(peer); });
  gone_.insert(gone_.end(), now.gone.begin(), now.gone.end());
  std::sort(gone_.begin(), gone_.end());
}

/// Peers are at most a step apart, and a member's number was assigned at an earlier step.
std::string Losses::fault_of(const Loss& told, const State& now) {
  assert(std::ranges::is_sorted(told.gone));
  if (!told.gone.empty() && told.gone.back() >= now.next_number)
    return "sends the loss of peer " + std::to_string(told.gone.back()) + ", which never was";
  if (told.step > now.step + 1)
    return "is at step " + std::to_string(told.step) + ", here it is " + std::to_string(now.step);
  return {};
}

void Losses::hear(PeerNumber from, Loss told) {
  assert(from < heard_.size());
  heard_[from] = std::move(told);
}

const std::optional<Loss>& Losses::heard(PeerNumber from) const {
  assert(from < heard_.size());
  return heard_[from];
}

void Losses::make_room(PeerNumber slots) {
  if (slots > heard_.size()) heard_.resize(slots);
}

/// A majority is more than half; or half, with the first of them. Of two peers either continues,
/// but the second one cannot know whether the first does too.
Losses::Majority Losses::majority_of(std::vector<PeerNumber> voters) const {
  std::erase_if(voters, [&](PeerNumber peer) { return State::is_in(finished_, peer); });
  const std::size_t count = voters.size();
  const auto left = static_cast<std::size_t>(
      std::count_if(voters.begin(), voters.end(), [&](PeerNumber peer) { return !is_gone(peer); }));
  if (left > 0 && (2 * left > count || (2 * left == count && !is_gone(voters.front()))))
    return Majority::sure;
  assert(left <= count);
  return left > 0 && count == 2 ? Majority::doubtful : Majority::none;
}

/// Majorities of neighbouring steps must have a common peer, too.
Losses::Majority Losses::majority(const State& now) const {
  return std::min(majority_of(now.voters()), majority_of(now.next_voters()));
}

void Losses::check() const {
  assert(std::ranges::adjacent_find(gone_, std::greater_equal<>()) == gone_.end());
  assert(std::ranges::includes(gone_, finished_));
}

}  // namespace rink::peer
