// What a person presses goes to the owner of the bat with the next claims; what the bat has felt
// follows from when that was.
#include "game/net/peer/hand_player.h"

#include <algorithm>
#include <utility>

#include "game/net/peer/crowd.h"

namespace rink::game {

HandPlayer::HandPlayer(const SharedGame& game, std::uint32_t player, Hand& hand)
    : game_(game), hand_(hand), pressed_(game.scene().bodies.bats[player].thrust), felt_(pressed_) {
  const EntityId bat = *game.start().bat(player);
  glimpse_ = {.bat = bat.index,
              .owner = 0,
              .time = 0.0,
              .position = game.start().position(bat),
              .velocity = game.start().velocity(bat),
              .pucks = {}};
}

void HandPlayer::before_window(peer::Session& session) {
  const double felt_at = session.peer().end();
  for (const HandPress& press : hand_.take_presses(felt_at)) waiting_.push_back(press);
  if (session.window() == 0) glimpse_.owner = session.division().owner_of(glimpse_.position);
  if (glimpse_.time != session.peer().now())
    return;  // its owner is lost, and the next one has not shown it yet
  for (const HandPress& press : std::exchange(waiting_, {})) {
    pressed_.press(press.key, press.is_down);
    const std::uint8_t input =
        input_of({0.0, 0, press.is_down ? InputKind::key_down : InputKind::key_up, press.key});
    session.press(
        glimpse_,
        {.bat = glimpse_.bat, .thrust = pressed_.thrust(), .input = input, .time = press.instant});
    sent_.push_back({session.window() + 1, std::max(felt_at, press.instant), press.instant,
                     press.key, press.is_down});
    ++presses_;
  }
}

void HandPlayer::after_window(const peer::Session& session) {
  for (const peer::Glimpse& glimpse : session.peer().glimpses())
    if (glimpse.bat == glimpse_.bat && glimpse.time > glimpse_.time) glimpse_ = glimpse;
  count_felt(session);
  hand_.show(sight_of(session));
  since_ = session.peer().now();
}

/// What was undone with a window when somebody was lost went again with the claims of the one that
/// was played just now.
void HandPlayer::count_felt(const peer::Session& session) {
  const double now = session.peer().now();
  if (session.lost().size() != std::exchange(lost_, session.lost().size()))
    for (Sent& sent : sent_)
      if (sent.window >= session.window())
        sent.window = session.window(), sent.stamp = std::max(now, sent.wanted);
  // What is stamped with the very end of the window with whose claims it went is felt in the next
  // one.
  const auto is_felt = [&](const Sent& sent) {
    return sent.stamp < now || (sent.stamp == now && sent.window < session.window());
  };
  for (; !sent_.empty() && is_felt(sent_.front()); sent_.pop_front())
    felt_.press(sent_.front().key, sent_.front().is_down);
}

PeerSight HandPlayer::sight_of(const peer::Session& session) const {
  const peer::Peer& peer = session.peer();
  PeerSight sight{.time = peer.now(),
                  .since = since_,
                  .window = session.window(),
                  .bodies = {},
                  .own_bat = glimpse_.bat,
                  .own_held = felt_.keys(),
                  .own_felt = felt_.input_count(),
                  .zones = {}};
  sight.own_position = glimpse_.position, sight.own_velocity = glimpse_.velocity;
  sight.bytes_sent = bytes_sent();
  sight.goals_left = session.scoring().left, sight.goals_right = session.scoring().right;
  sight.bodies.reserve(peer.owned().size() + peer.ghosts().size());
  add_bodies(peer, peer.owned(), KnownBody::Source::own, sight);
  add_bodies(peer, peer.ghosts(), KnownBody::Source::ghost, sight);
  if (viewer != nullptr) add_told(sight);
  sight.zones.own_peer = peer.number();
  sight.zones.halo = peer.halo();
  sight.zones.own_count = peer.owned().size();
  const physics::Field& field = game_.scene().world.field;
  for (const peer::PeerNumber member : session.members())
    for (const peer::Box& box : session.division().zones_of(member))
      sight.zones.zones.push_back({member, std::max(0.0, box.low_x), std::max(0.0, box.low_y),
                                   std::min(field.length, box.high_x),
                                   std::min(field.width, box.high_y)});
  return sight;
}

/// By their owners; of those that have come here meanwhile the picture keeps nothing for long.
void HandPlayer::add_told(PeerSight& sight) const {
  std::vector<std::uint32_t> here;
  for (const KnownBody& body : sight.bodies) here.push_back(body.body);
  std::sort(here.begin(), here.end());
  for (const auto& [body, belief] : viewer->interest().picture().beliefs()) {
    if (!belief.is_there || game_.start().world().kind({body}) == physics::BodyKind::post ||
        std::binary_search(here.begin(), here.end(), body))
      continue;
    sight.zones.told.push_back(body);
    sight.bodies.push_back({.body = body,
                            .source = KnownBody::Source::told,
                            .motion = belief.motion,
                            .thrust = belief.motion.acceleration});
  }
}

void HandPlayer::add_bodies(const peer::Peer& peer, const std::vector<std::uint32_t>& bodies,
                            KnownBody::Source source, PeerSight& sight) const {
  const physics::World& world = peer.world();
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
