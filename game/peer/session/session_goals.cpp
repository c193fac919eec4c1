// Between stretches of a window: counts goals, and puts pucks back. docs/peer-to-peer.md, "Goals".
#include <algorithm>
#include <bit>
#include <cassert>

#include "game/peer/session/session.h"

namespace rink::peer {

/// The end of the next stretch: a window is cut where a puck comes back. `state` is that at the
/// start of the stretch, where due pucks come back.
double Session::stretch_end(const State& state) const {
  return std::min(settings_.end_of(state.window + 1), state.scoring.next_after(state.time));
}

/// Counts the goals in the final verdicts of all.
void Session::count_goals(State& next) const {
  if (!settings_.goals) return;
  std::vector<Goal> goals;
  for (const PeerNumber peer : now_.members) {
    for (const Goal& goal : peer_->verdicts().of(peer).goals) {
      const auto is_of_it = [&](const auto& other) { return other.puck == goal.puck; };
      const bool can_be =
          whole_.has_puck(goal.puck) && goal.time >= now_.time - 1e-9 &&
          goal.time <= next.time + 1e-9 && std::none_of(goals.begin(), goals.end(), is_of_it) &&
          std::none_of(now_.scoring.face_offs.begin(), now_.scoring.face_offs.end(), is_of_it);
      if (!can_be) give_up(peer, "peer " + std::to_string(peer) + " sent a goal that cannot be");
      goals.push_back(goal);
    }
  }
  next.scoring.count(std::move(goals), *settings_.goals);
}

/// Puts back all pucks that are due at the end of the committed stretch.
void Session::face_off(State& next) {
  while (next.scoring.next() <= next.time) {
    const FaceOff due = next.scoring.face_offs.front();
    next.scoring.face_offs.erase(next.scoring.face_offs.begin());
    if (!put_back(due))
      next.scoring.schedule({due.time + settings_.goals->placement_retry, due.puck, due.is_left});
  }
}

/// Each peer knows its own bodies, so a place is free if it is free at all peers. False if none is.
bool Session::put_back(const FaceOff& due) {
  constexpr std::size_t asked = 64;
  assert(whole_.has_puck(due.puck) && settings_.goals);
  const double radius = whole_.puck_radii[due.puck];
  for (std::size_t first = 0;; first += asked) {
    const std::vector<Vector2> places = settings_.goals->places(due.is_left, radius, first, asked);
    if (places.empty()) return false;
    assert(places.size() <= asked && "a word has one bit for each");
    FaceOffWord word{.puck = due.puck, .taken = 0, .body = {}};
    for (std::size_t k = 0; k < places.size(); ++k)
      if (!peer_->world().is_free(places[k], radius)) word.taken |= std::uint64_t{1} << k;
    if (peer_->share().owns(due.puck))
      word.body.push_back({due.puck, peer_->share().state(due.puck)});
    const std::uint64_t taken = agree_on(word);
    const auto free = static_cast<std::size_t>(std::countr_one(taken));
    if (free < places.size()) {
      assert(word.body.front().number == due.puck);
      peer_->put_back(word.body.front(), places[free]);
      return true;
    }
    if (places.size() < asked) return false;
  }
}

/// Exchanges the peers' messages, and returns the places that are taken at any peer. `word` has the
/// puck afterwards.
std::uint64_t Session::agree_on(FaceOffWord& word) {
  for (const PeerNumber to : now_.members)
    if (to != settings_.number) mail_.send(to, written(word));
  std::uint64_t taken = word.taken;
  for (const PeerNumber from : now_.members) {
    if (from == settings_.number) continue;
    const auto word_received = checked<FaceOffWord>(from, peer_->now());
    if (word_received.puck != word.puck ||
        (!word_received.body.empty() && word_received.body.front().number != word.puck))
      give_up(from, "peer " + std::to_string(from) + " sends puck " +
                        std::to_string(word_received.puck) + " where puck " +
                        std::to_string(word.puck) + " is due");
    taken |= word_received.taken;
    if (word.body.empty()) word.body = word_received.body;
  }
  if (word.body.empty())
    throw ProtocolError("no peer has puck " + std::to_string(word.puck) + ", which is due");
  return taken;
}

}  // namespace rink::peer
