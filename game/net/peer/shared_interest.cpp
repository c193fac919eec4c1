// Around each window: where the player looks, what others are told, and keys.
#include "game/net/peer/shared_interest.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "rti/wire/stream.h"

namespace rink::game {

namespace {

std::vector<physics::BodyKind> kinds_of(const Game& game) {
  std::vector<physics::BodyKind> kinds(game.world().body_count(), physics::BodyKind::puck);
  for (const Entity& entity : game.entities()) kinds[entity.id.index] = entity.kind;
  return kinds;
}

/// As the server's.
im::FilterSettings filter_settings(const Game& start, double cell_size) {
  const physics::Field& field = start.world().spec().field;
  im::FilterSettings settings{.world = {0.0, 0.0, field.length, field.width}, .cell_size = cell_size};
  for (const Entity& entity : start.entities())
    if (entity.kind == physics::BodyKind::post) settings.posts.push_back({start.position(entity.id).x(), start.position(entity.id).y(), entity.half_extent.x()});
  return settings;
}

/// A bat is of its team and its player's; posts are always relevant.
im::Role role_of(const Entity& entity) {
  im::Role role;
  if (entity.player) role.owner = *entity.player;
  if (entity.team != Team::none) role.team = static_cast<std::uint32_t>(entity.team);
  role.is_always_relevant = entity.kind == physics::BodyKind::post;
  return role;
}

Drag drag_of(const physics::WorldSpec& spec) { return {.pucks = spec.puck_drag, .bats = spec.bat_drag, .puck_friction = spec.puck_friction}; }

}  // namespace

SharedInterest::SharedInterest(const Game& start, const InterestSettings& settings, const peer::Peer& peer, const peer::Division& division, Send send)
    : settings_(settings),
      peer_(peer),
      division_(division),
      send_(std::move(send)),
      interest_(settings.scheme, filter_settings(start, settings.cell_size), settings.policy, peer_count(), start.world().body_count()),
      picture_(interest_.tells_trajectories(), drag_of(start.world().spec()), kinds_of(start)),
      places_(start.world().body_count(), Place::away),
      is_told_(peer_count(), false),
      heard_(peer_count(), 0),
      playing_(heard_),
      felt_(heard_),
      told_felt_(heard_),
      handed_to_(peer_count(), peer.number()) {
  for (const Entity& entity : start.entities()) extent_max_ = std::max(extent_max_, entity.half_extent.maxCoeff());
  std::vector<im::Role> of_bodies(start.world().body_count()), of_players(peer_count());
  for (const Entity& entity : start.entities()) of_bodies[entity.id.index] = role_of(entity);
  for (peer::PeerNumber peer = 0; peer < peer_count(); ++peer)
    if (settings.bats[peer] != no_bat) of_players[peer] = of_bodies[settings.bats[peer]];
  interest_.set_roles(std::move(of_bodies), std::move(of_players));
  if (bat() != no_bat) seen_bat_ = start.position({bat()});
}

void SharedInterest::say(peer::PeerNumber to, Traffic about, rti::Bytes content) {
  std::vector<std::uint8_t> bytes(content.size());
  if (!content.empty()) std::memcpy(bytes.data(), content.data(), content.size());
  send_(to, about, std::move(bytes));
}

void SharedInterest::look_around() {
  if (!interest_.is_selective() || bat() == no_bat) return;
  bool is_new = false;
  if (const std::optional<physics::Vector2> centre = bat_place()) {
    const double reach = settings_.half_side + settings_.margin;
    const im::Region region{centre->x() - reach, centre->y() - reach, centre->x() + reach, centre->y() + reach};
    const physics::Vector2 before{0.5 * (static_cast<double>(gaze_.low_x) + static_cast<double>(gaze_.high_x)), 0.5 * (static_cast<double>(gaze_.low_y) + static_cast<double>(gaze_.high_y))};
    const bool is_near = gaze_.form == Gaze::Form::region && settings_.margin > 0.0 && (*centre - before).cwiseAbs().maxCoeff() < 0.5 * settings_.margin;
    const Gaze gaze = is_near ? gaze_ : gaze_at(region, interest_.cell_size());
    is_new = gaze != gaze_;
    gaze_ = gaze;
  }
  if (gaze_.form == Gaze::Form::away) return;
  const im::Region region = region_of(gaze_, interest_.cell_size());
  if (is_new) interest_.look(peer_.number(), region);
  // Zones may have moved though the view has not. Cells that are touched count whole.
  const double grown = extent_max_ + interest_.cell_size();
  for (peer::PeerNumber other = 0; other < peer_count(); ++other) {
    if (other == peer_.number()) continue;
    const bool is_near = interest_.reaches_everywhere() || division_.is_near(other, {region.low_x, region.low_y, region.high_x, region.high_y}, grown);
    if (is_near && (is_new || !is_told_[other])) say(other, Traffic::interest, bytes_of(gaze_));
    if (!is_near && is_told_[other]) say(other, Traffic::interest, bytes_of(Gaze{})), picture_.forget(other);
    is_told_[other] = is_near;
  }
}

/// Where it is, or was when it was last seen; at first, where it starts.
std::optional<physics::Vector2> SharedInterest::bat_place() {
  const Belief& belief = picture_.belief(bat());
  if (places_[bat()] != Place::away) seen_bat_ = peer_.world().position({bat()});
  else if (belief.is_there) seen_bat_ = belief.position_at(peer_.now());
  return seen_bat_;
}

void SharedInterest::finish(std::uint32_t window) {
  felt_ = playing_;
  interest_.match(peer_);
  tell(window);
  hand_keys_over();
}

void SharedInterest::tell(std::uint32_t window) {
  for (peer::PeerNumber player = 0; player < peer_count(); ++player) {
    if (player == peer_.number()) continue;
    const auto newly_felt = [&](std::uint32_t body) -> std::optional<std::uint32_t> {
      if (body != settings_.bats[player] || felt_[player] <= told_felt_[player]) return std::nullopt;
      return told_felt_[player] = felt_[player];
    };
    const std::vector<std::byte> updates = interest_.updates_for(peer_, player, window, newly_felt);
    if (!updates.empty()) say(player, Traffic::updates, updates);
  }
}

/// To who owns a bat from now on, what came for it here.
void SharedInterest::hand_keys_over() {
  for (peer::PeerNumber player = 0; player < peer_count(); ++player) {
    const std::uint32_t bat = settings_.bats[player];
    if (bat == no_bat || places_[bat] != Place::own) continue;
    const peer::PeerNumber owner = division_.owner_of(peer_.world().position({bat}));
    if (owner == peer_.number()) continue;
    handed_to_[player] = owner;
    say_keys(owner, KeyWord::heard, player, heard_[player]);
  }
}

/// Who is here is seen, not told; who has just come only from the next decision on, in which it takes part.
void SharedInterest::note_places() {
  picture_.drop_forgotten();
  const std::vector<std::uint32_t> before = std::move(here_);
  here_ = peer_.owned();
  here_.insert(here_.end(), peer_.ghosts().begin(), peer_.ghosts().end());
  for (const std::uint32_t body : here_)
    if (places_[body] != Place::away) picture_.forget_body(body);
  for (const std::uint32_t body : before) places_[body] = Place::away;
  for (const std::uint32_t body : peer_.owned()) places_[body] = Place::own;
  for (const std::uint32_t body : peer_.ghosts()) places_[body] = Place::ghost;
}

void SharedInterest::begin_again(std::span<const peer::PeerNumber> members) {
  for (peer::PeerNumber peer = 0; peer < peer_count(); ++peer) {
    const bool is_there = std::find(members.begin(), members.end(), peer) != members.end();
    if (!is_there && interest_.is_selective()) interest_.look_away(peer);
    if (!is_there) is_told_[peer] = false;
    interest_.forget_told(peer);
    picture_.forget(peer);
  }
  note_places();
}

peer::PeerNumber SharedInterest::owner_of_bat(peer::PeerNumber player) const {
  const std::uint32_t bat = settings_.bats[player];
  if (bat == no_bat) return player;
  if (places_[bat] == Place::own) return peer_.number();
  if (places_[bat] == Place::ghost) return division_.owner_of(peer_.world().position({bat}));
  const Belief& belief = picture_.belief(bat);
  return belief.is_there ? belief.source : handed_to_[player];
}

void SharedInterest::press() {
  ++pressed_;
  const peer::PeerNumber owner = owner_of_bat(peer_.number());
  heard_[peer_.number()] = pressed_;
  if (owner != peer_.number()) say_keys(owner, KeyWord::pressed, peer_.number(), pressed_);
}

void SharedInterest::say_keys(peer::PeerNumber to, KeyWord word, peer::PeerNumber player, std::uint32_t count) {
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  writer.number(word);
  writer.varint(player);
  writer.varint(count);
  say(to, Traffic::keys, bytes);
}

bool SharedInterest::hear_keys(rti::Bytes content) {
  rti::Reader reader(content);
  std::uint8_t word = 0;
  peer::PeerNumber player = 0;
  std::uint32_t count = 0;
  if (!reader.range(word, 1) || !reader.varint(player) || player >= peer_count() || !reader.varint(count) || !reader.is_at_end()) return false;
  const bool is_news = count > heard_[player];
  heard_[player] = std::max(heard_[player], count);
  const peer::PeerNumber owner = owner_of_bat(player);
  if (is_news && player != peer_.number() && owner != peer_.number() && static_cast<KeyWord>(word) == KeyWord::pressed) say_keys(owner, KeyWord::pressed, player, count);
  return true;
}

bool SharedInterest::hear(peer::PeerNumber from, Traffic about, rti::Bytes content) {
  if (from >= peer_count()) return false;
  switch (about) {
    case Traffic::halo:
    case Traffic::claims:
    case Traffic::agreement: return false;
    case Traffic::keys: return hear_keys(content);
    case Traffic::updates: return picture_.hear(from, content, settings_.rate_hz);
    case Traffic::interest: break;
  }
  const std::optional<Gaze> gaze = gaze_from(content);
  if (!gaze || !interest_.is_selective()) return false;
  if (gaze->form == Gaze::Form::away) interest_.look_away(from);
  else interest_.look(from, region_of(*gaze, interest_.cell_size()));
  return true;
}

std::uint32_t SharedInterest::felt() const {
  if (bat() == no_bat) return 0;
  return places_[bat()] == Place::own ? std::max(felt_[peer_.number()], picture_.felt()) : picture_.felt();
}

void SharedInterest::list_scope(std::vector<std::uint32_t>& bodies) const {
  bodies.clear();
  for (const std::uint32_t body : interest_.scope_of(peer_.number()))
    if (places_[body] != Place::away && !picture_.belief(body).is_there) bodies.push_back(body);
  for (const auto& [body, belief] : picture_.beliefs())
    if (belief.is_there) bodies.push_back(body);
}

physics::Motion SharedInterest::motion_of(std::uint32_t body) const {
  if (places_[body] == Place::away) return picture_.belief(body).motion;
  const physics::World& world = peer_.world();
  if (!world.is_resting({body})) return world.motion({body});
  physics::Motion still;
  still.time = world.now();
  still.position = world.position({body});
  return still;
}

physics::Vector2 SharedInterest::position_at(std::uint32_t body, double instant) const {
  if (places_[body] == Place::away) return picture_.belief(body).position_at(instant);
  const physics::World& world = peer_.world();
  if (instant <= world.now()) return world.position({body});
  const physics::Motion motion = motion_of(body);
  return motion.at(std::max(instant, motion.time)).position;
}

}  // namespace rink::game
