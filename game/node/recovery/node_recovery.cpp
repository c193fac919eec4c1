// Undoes a node's steps in this order, since each part depends on the one before: the windows
// played, the messages to other nodes, the keys, the seats.
#include "game/node/recovery/node_recovery.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "game/net/peer/crowd.h"
#include "game/node/node_messages.h"
#include "game/peer/message_bytes.h"

namespace rink::game {

NodeRecovery::NodeRecovery(const Parts& parts, Handler handle)
    : parts_(parts), handle_(std::move(handle)) {
  assert(handle_ != nullptr);
}

std::uint32_t NodeRecovery::bat_of(std::uint32_t player) const {
  return parts_.game.start().bat(player)->index;
}

void NodeRecovery::host(MatchRecovery::Hooks hooks, NodeMatch& match) {
  hooks.receive = handle_;
  matches_.emplace(MatchRecovery::Parts{parts_.network, parts_.game, parts_.seats, match},
                   std::move(hooks));
}

std::optional<bool> NodeRecovery::sort(peer::PeerNumber from,
                                       const std::vector<std::uint8_t>& bytes) {
  if (matches_) return matches_->sort(from, bytes);
  if (bytes.size() < node_message_tail) return false;
  const std::uint16_t theirs = recoveries_in(bytes), own = parts_.network.recoveries;
  const bool is_replicated = parts_.network.terms().is_replicated;
  if (kind_of(bytes) == NodeMessage::stand_in) {
    StandIn stand_in;
    const auto said =
        std::ranges::count(stand_ins_, from, &std::pair<peer::PeerNumber, StandIn>::first);
    if (!is_replicated || static_cast<std::size_t>(said) >= stand_ins_max ||
        !peer::read_whole(content_of(bytes), stand_in))
      return false;
    stand_ins_.emplace_back(from, std::move(stand_in));
    return true;
  }
  if (theirs < own) return true;
  if (theirs == own) return std::nullopt;
  if (!is_replicated || early_.size() >= early_max) return false;
  early_.emplace_back(from, bytes);
  return true;
}

bool NodeRecovery::receive(peer::PeerNumber from, peer::PartChange change) try {
  return parts_.receiver->receive(from, std::move(change));
} catch (const FaultyPart&) {
  if (!parts_.network.terms().is_replicated) throw;
  return false;
}

/// What a lost node told this one of its last stretch may lack bodies that have come since.
void NodeRecovery::add_all_own(peer::PartChange& own, const peer::Peer& peer) {
  std::vector<std::uint32_t> listed;
  for (const peer::Handover::Body& body : own.bodies) listed.push_back(body.number);
  for (const peer::FreeFlightState& flight : own.free_flights) listed.push_back(flight.number);
  std::ranges::sort(listed);
  for (const std::uint32_t body : peer.owned())
    if (peer.world().kind({body}) != physics::BodyKind::post &&
        !std::ranges::binary_search(listed, body))
      own.bodies.push_back({body, peer.share().state(body)});
  std::ranges::sort(own.bodies, {}, &peer::Handover::Body::number);
}

void NodeRecovery::finish_window(peer::PartChange own, const peer::Session& session) try {
  if (std::exchange(is_anew_, false)) add_all_own(own, session.peer());
  parts_.receiver->finish_window(std::move(own), session.division(), session.peer().share());
} catch (const FaultyPart& fault) {
  if (!parts_.network.terms().is_replicated) throw;
  throw peer::PeerGone(fault.from(), false, fault.what());
}

void NodeRecovery::note_felt() {
  for (const peer::Key& key : parts_.feed.take_felt()) {
    const InputEvent event = event_of(key.input, key.time, 0);
    held_[key.bat].set(event.key, event.kind == InputKind::key_down);
    parts_.players.note_felt(key);
  }
}

void NodeRecovery::follow() {
  note_felt();
  std::erase_if(inherited_, [this](Inherited& each) {
    const auto& [player, token] = each.seated;
    if (!each.is_released) {
      if (!parts_.feed.is_whole(each.after + 1)) return false;
      parts_.players.release(player, held_[bat_of(player)]);
      each.is_released = true;
    }
    if (parts_.players.has_unfelt(player)) return false;
    parts_.seats.wish({.change = SeatChange::leave, .player = player, .token = token});
    return true;
  });
}

/// Posts are where they always are.
void NodeRecovery::take_over(peer::PeerNumber lost, const peer::Part& part,
                             std::span<const peer::Key> keys) {
  const std::uint64_t stretch = parts_.feed.stretch_until(part.time);
  if (stretch == 0) return;  // all know the start
  StandIn stand_in{.node = lost};
  stand_in.change.step = stretch, stand_in.change.time = part.time;
  stand_in.change.bodies = part.bodies;
  stand_in.change.rest_contacts = part.rest_contacts;
  stand_in.change.log.assign(keys.begin(), keys.end());
  const physics::World& start = parts_.game.start().world();
  std::erase_if(stand_in.change.bodies, [&](const peer::Handover::Body& body) {
    return body.number < start.body_count() && start.kind({body.number}) == physics::BodyKind::post;
  });
  tell_others(parts_.network, NodeMessage::stand_in, peer::bytes_from(stand_in));
  stand_ins_.emplace_back(parts_.network.number(), std::move(stand_in));
}

/// Equal at all: all have the same decisions up to that window.
void NodeRecovery::seat_again(peer::Session& session, peer::Peer& peer) {
  parts_.seats.rewind(session.window(), end_of_window(parts_.network.terms(), session.window()));
  const std::vector<peer::PeerNumber>& lost = session.lost();
  peer::PeerNumber referee = 0;
  while (std::ranges::binary_search(lost, referee)) ++referee;
  const std::vector<SeatTable::Seated> inherited = parts_.seats.lose(lost, referee);
  if (referee == parts_.network.number())
    for (const SeatTable::Seated& seated : inherited) inherited_.push_back({.seated = seated});
  for (const auto& [player, node] : parts_.seats.holders())
    peer.players().move_seat({.bat = bat_of(player), .peer = node, .period = 0.0, .puck_count = 0});
}

/// Recoveries are counted by their steps and losses: a loss may undo another's recovery, and takes
/// its step.
void NodeRecovery::go_back(peer::Session& session, std::span<const peer::Key> pending) {
  const std::uint64_t stretch = parts_.feed.stretch_until(session.peer().now());
  assert((stretch > 0) == (session.peer().now() > 0.0));
  session.peer().keep_changes();
  if (!parts_.feed.rewind(stretch))
    throw peer::ProtocolError("others go back behind what all had told, which no honest node does");
  parts_.receiver->rewind(stretch, session.division());
  close(session.lost(), stretch);
  parts_.teller->begin_again(session.peer(), stretch);
  is_anew_ = true;
  parts_.subscription.take_again();
  note_felt();
  for (const peer::Key& key : pending) parts_.players.note_felt(key);
  parts_.players.send_again(session);
  for (Inherited& each : inherited_) each.after = stretch;
  parts_.network.recoveries =
      static_cast<std::uint16_t>(session.step() - stretch + session.lost().size());
  handle_early();
}

/// Who keeps the copy of a node's part: the next in the ring of those that were there.
peer::PeerNumber NodeRecovery::keeper_of(peer::PeerNumber node) const {
  do node = (node + 1) % parts_.network.terms().peer_count;
  while (parts_.feed.is_closed(node));
  return node;
}

/// Nothing more comes of lost nodes than who stands in for them says.
void NodeRecovery::close(const std::vector<peer::PeerNumber>& lost, std::uint64_t stretch) {
  for (auto& [from, each] : std::exchange(stand_ins_, {}))
    if (std::ranges::binary_search(lost, each.node) && each.change.step == stretch &&
        !parts_.feed.is_closed(each.node) && from == keeper_of(each.node))
      parts_.receiver->stand_in(each.node, std::move(each.change));
  for (const peer::PeerNumber node : lost) {
    if (parts_.feed.is_closed(node)) continue;  // since an earlier loss
    if (parts_.feed.count(node) < stretch)
      throw peer::ProtocolError("nobody has told what the lost peer " + std::to_string(node) +
                                " played last");
    parts_.feed.close(node);
  }
}

void NodeRecovery::handle_early() {
  for (auto& [from, bytes] : std::exchange(early_, {})) {
    const std::optional<bool> sorted = sort(from, bytes);
    if (!(sorted ? *sorted : handle_(from, bytes)))
      throw peer::PeerGone(
          from, false, "peer " + std::to_string(from) + " sent a side message that no peer sends");
  }
}

}  // namespace rink::game
