// Sends a person's keys to the owner of the bat with the next claims, and derives from their
// windows which have taken effect.
#include "game/net/peer/local_player.h"

#include <algorithm>
#include <utility>

#include "game/net/peer/crowd.h"

namespace rink::game {

LocalPlayer::LocalPlayer(const SharedGame& game, std::uint32_t player, InputQueue& input)
    : game_(game),
      input_(input),
      pressed_(game.scene().bodies.bats[player].thrust),
      felt_(pressed_) {
  const EntityId bat = *game.start().bat(player);
  observation_ = {.bat = bat.index,
                  .owner = 0,
                  .time = 0.0,
                  .position = game.start().position(bat),
                  .velocity = game.start().velocity(bat),
                  .pucks = {}};
}

void LocalPlayer::before_window(peer::Session& session) {
  const double felt_at = session.peer().end();
  for (const KeyInput& press : input_.take_presses(felt_at)) waiting_.push_back(press);
  if (session.window() == 0)
    observation_.owner = session.division().owner_of(observation_.position);
  if (observation_.time != session.peer().now())
    return;  // its owner is lost, and the next one has not sent an observation yet
  for (const KeyInput& press : std::exchange(waiting_, {})) {
    pressed_.press(press.key, press.is_down);
    const std::uint8_t input =
        input_of({0.0, 0, press.is_down ? InputKind::key_down : InputKind::key_up, press.key});
    session.press(observation_, {.bat = observation_.bat,
                                 .thrust = pressed_.thrust(),
                                 .input = input,
                                 .time = press.instant});
    sent_.push_back({session.window() + 1, std::max(felt_at, press.instant), press.instant,
                     press.key, press.is_down});
    ++presses_;
  }
}

void LocalPlayer::after_window(const peer::Session& session) {
  for (const peer::Observation& observation : session.peer().observations())
    if (observation.bat == observation_.bat && observation.time > observation_.time)
      observation_ = observation;
  count_felt(session);
  input_.show(sight_of(session));
  since_ = session.peer().now();
}

/// Keys that were undone with a window when a peer was lost were sent again with the claims of the
/// window that was just played.
void LocalPlayer::count_felt(const peer::Session& session) {
  const double now = session.peer().now();
  if (session.lost().size() != std::exchange(lost_, session.lost().size()))
    for (Sent& sent : sent_)
      if (sent.window >= session.window())
        sent.window = session.window(), sent.stamp = std::max(now, sent.wanted);
  // A key that is stamped with the end of the window with whose claims it was sent takes effect in
  // the next one.
  const auto is_felt = [&](const Sent& sent) {
    return sent.stamp < now || (sent.stamp == now && sent.window < session.window());
  };
  for (; !sent_.empty() && is_felt(sent_.front()); sent_.pop_front())
    felt_.press(sent_.front().key, sent_.front().is_down);
}

PeerSight LocalPlayer::sight_of(const peer::Session& session) const {
  const peer::Peer& peer = session.peer();
  PeerSight sight{.time = peer.now(),
                  .since = since_,
                  .window = session.window(),
                  .bodies = {},
                  .own_bat = observation_.bat,
                  .own_held = felt_.keys(),
                  .own_felt = felt_.input_count(),
                  .zones = {}};
  sight.own_position = observation_.position, sight.own_velocity = observation_.velocity;
  sight.bytes_sent = bytes_sent();
  sight.goals_left = session.scoring().left, sight.goals_right = session.scoring().right;
  sight.bodies.reserve(peer.owned().size() + peer.ghosts().size());
  add_bodies(peer, peer.owned(), KnownBody::Source::own, sight);
  add_bodies(peer, peer.ghosts(), KnownBody::Source::ghost, sight);
  if (viewer != nullptr) add_replicas(sight);
  sight.zones.own_peer = peer.number();
  sight.zones.halo = peer.halos().own();
  sight.zones.own_count = peer.owned().size();
  const physics::Field& field = game_.scene().world.field;
  for (const peer::PeerNumber member : session.members())
    for (const peer::Box& box : session.division().zones_of(member))
      sight.zones.zones.push_back({member, std::max(0.0, box.low_x), std::max(0.0, box.low_y),
                                   std::min(field.length, box.high_x),
                                   std::min(field.width, box.high_y)});
  return sight;
}

/// Adds replicas by their owners' updates; those of bodies that have come here meanwhile are
/// dropped soon.
void LocalPlayer::add_replicas(PeerSight& sight) const {
  std::vector<std::uint32_t> here;
  for (const KnownBody& body : sight.bodies) here.push_back(body.body);
  std::sort(here.begin(), here.end());
  for (const auto& [body, replica] : viewer->interest().replicas().all()) {
    if (!replica.is_there || game_.start().world().kind({body}) == physics::BodyKind::post ||
        std::binary_search(here.begin(), here.end(), body))
      continue;
    sight.zones.received.push_back(body);
    sight.bodies.push_back({.body = body,
                            .source = KnownBody::Source::told,
                            .motion = replica.motion,
                            .thrust = replica.motion.acceleration});
  }
}

void LocalPlayer::add_bodies(const peer::Peer& peer, const std::vector<std::uint32_t>& bodies,
                             KnownBody::Source source, PeerSight& sight) const {
  const physics::PartWorld& world = peer.world();
  for (const std::uint32_t body : bodies) {
    if (world.kind({body}) == physics::BodyKind::post) continue;
    if (source == KnownBody::Source::ghost) sight.zones.ghosts.push_back(body);
    sight.bodies.push_back({.body = body,
                            .source = source,
                            .is_in_play = world.is_in_play({body}),
                            .motion = world.motion({body}),
                            .thrust = world.thrust({body})});
  }
}

}  // namespace rink::game
