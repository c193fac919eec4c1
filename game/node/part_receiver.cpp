// Zones are those at a window's end, which a node knows once it has played the window itself: what
// comes earlier waits.
#include "game/node/part_receiver.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "game/net/peer/shared_game.h"
#include "game/peer/protocol.h"

namespace rink::game {
namespace {

std::vector<physics::BodyKind> kinds_of(const physics::World& world) {
  std::vector<physics::BodyKind> kinds;
  for (std::uint32_t body = 0; body < world.body_count(); ++body)
    kinds.push_back(world.kind({body}));
  return kinds;
}

/// The bodies of a change in their whole states, as far as their places go.
std::vector<peer::Handover::Body> bodies_of(const peer::PartChange& change, double puck_drag) {
  std::vector<peer::Handover::Body> bodies = change.bodies;
  for (const peer::FreeFlightState& flight : change.free_flights) {
    bodies.push_back({flight.number, {}});
    bodies.back().state.drag = peer::Vector2::Constant(puck_drag);
    flight.write_to(bodies.back().state.flight);
  }
  return bodies;
}

}  // namespace

PartReceiver::PartReceiver(const physics::World& whole, const Terms& terms, peer::PeerNumber own,
                           WindowFeed& feed)
    : own_(own),
      feed_(feed),
      validator_(whole),
      puck_drag_(whole.spec().puck_drag),
      kinds_(kinds_of(whole)),
      received_(terms.peer_count, 0),
      early_(terms.peer_count) {
  assert(own < terms.peer_count);
}

bool PartReceiver::is_sound(peer::PeerNumber from, const peer::PartChange& change) const {
  if (from >= received_.size() || from == own_ || change.is_whole ||
      change.step != received_[from] + 1 || change.step < received_[own_] ||
      change.step > received_[own_] + 1 ||
      !validator_.fault_of(change, feed_.end_of(change.step)).empty())
    return false;
  const double begin = change.step == 1 ? 0.0 : feed_.end_of(change.step - 1);
  const auto is_post = [this](std::uint32_t body) {
    return kinds_[body] == physics::BodyKind::post;
  };
  return std::ranges::all_of(change.log,
                             [&](const peer::Key& key) {
                               return key.input != 0 && key.time >= begin &&
                                      key.time <= change.time;
                             }) &&
         std::ranges::none_of(change.gone, is_post) &&
         std::ranges::none_of(change.bodies, is_post, &peer::Handover::Body::number) &&
         std::ranges::none_of(change.free_flights, is_post, &peer::FreeFlightState::number);
}

bool PartReceiver::receive(peer::PeerNumber from, peer::PartChange change) {
  if (!is_sound(from, change)) return false;
  const std::uint64_t step = ++received_[from];
  if (step > received_[own_]) early_[from] = std::move(change);
  else pass(from, std::move(change));
  return true;
}

void PartReceiver::finish_window(peer::PartChange own, const peer::Division& division,
                                 const peer::Share& share) {
  assert(own.step == received_[own_] + 1);
  ++received_[own_];
  division_ = division;
  share_ = &share;
  feed_.add(own_, std::move(own));
  std::optional<FaultyPart> first;
  for (peer::PeerNumber from = 0; from < early_.size(); ++from)
    if (std::optional<peer::PartChange> change = std::exchange(early_[from], std::nullopt)) try {
        pass(from, std::move(*change));
      } catch (const FaultyPart& fault) {
        if (!first) first.emplace(fault);
      }
  if (first) throw FaultyPart(*first);
}

void PartReceiver::pass(peer::PeerNumber from, peer::PartChange change) {
  assert(change.step == received_[own_]);
  if (const std::string fault = fault_of(from, change); !fault.empty()) {
    --received_[from];  // whoever stands in for it may still tell
    throw FaultyPart(from, fault);
  }
  feed_.add(from, std::move(change));
}

void PartReceiver::rewind(std::uint64_t window, const peer::Division& division) {
  assert(window <= received_[own_]);
  for (std::uint64_t& received : received_) received = std::min(received, window);
  for (std::optional<peer::PartChange>& early : early_) early.reset();
  division_ = division;
}

/// Its zones are others' by now.
bool PartReceiver::stand_in(peer::PeerNumber from, peer::PartChange change) {
  if (from >= received_.size() || from == own_) return false;
  if (received_[from] == change.step) return true;
  if (!change.gone.empty() || change.step != received_[own_] || !is_sound(from, change))
    return false;
  ++received_[from];
  feed_.add(from, std::move(change));
  return true;
}

/// What cannot be of bodies that exist; empty if there is nothing.
std::string PartReceiver::fault_of(peer::PeerNumber from, const peer::PartChange& change) const {
  assert(division_ && share_ != nullptr);
  if (const auto body =
          peer::first_elsewhere(bodies_of(change, puck_drag_), change.time, *division_, {{from}}))
    return " tells of body " + std::to_string(*body) + ", which is in none of its zones";
  const auto own =
      std::ranges::find_if(change.gone, [this](std::uint32_t body) { return share_->owns(body); });
  return own == change.gone.end()
             ? std::string()
             : " tells no more of body " + std::to_string(*own) + ", which is this node's";
}

}  // namespace rink::game
