// The steps around each window: the player's view, updates to others, and keys.
#include "game/net/peer/interest/shared_interest.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <utility>

#include "game/replication/filter_setup.h"
#include "im/filter.h"
#include "rti/wire/stream.h"

namespace rink::game {

namespace {

std::vector<physics::BodyKind> kinds_of(const Game& game) {
  std::vector<physics::BodyKind> kinds(game.world().body_count(), physics::BodyKind::puck);
  for (const Entity& entity : game.entities()) kinds[entity.id.index] = entity.kind;
  return kinds;
}

/// The filter settings of a server, but that cells whose size nobody gave have one that follows
/// from the world: peers send each other numbers of cells before they know each other's views.
im::FilterSettings settings_of_peers(const Scene& scene, double cell_size) {
  im::FilterSettings settings = filter_settings(scene, cell_size);
  settings.cell_size = im::cell_size_of(settings);
  return settings;
}

std::vector<im::Role> roles_of(const Game& start, RelevantKinds always) {
  std::vector<im::Role> roles(start.world().body_count());
  for (const Entity& entity : start.entities())
    roles[entity.id.index] = role_of(entity, always.has(entity.kind));
  return roles;
}

/// Keeps replicas from `from`, which sends no more: they count as the `own` peer's, in `kept`,
/// until their new source has sent them.
void keep_for_now(PeerReplicas& picture, peer::PeerNumber from, peer::PeerNumber own,
                  std::vector<std::uint32_t>& kept) {
  for (const auto& [body, replica] : picture.all()) {
    if (!replica.is_there || replica.source != from) continue;
    kept.push_back(body);
    picture.assume(body, {own, true, replica.motion});
  }
}

}  // namespace

SharedInterest::SharedInterest(const SharedStart& start, const InterestSettings& settings,
                               const peer::Peer& peer, const peer::Division& division, Send send)
    : settings_(settings),
      peer_(peer),
      division_(division),
      send_(std::move(send)),
      view_(settings.margin),
      interest_(settings.scheme, settings_of_peers(start.scene, settings.cell_size),
                settings.policy, roles_of(start.game, settings.always_relevant), start.extent_max),
      replicas_(interest_.sends_trajectories(), Drag::of(start.scene.world), kinds_of(start.game)),
      places_(start.game.world().body_count(), Place::away) {
  std::vector<peer::PeerNumber> all(settings.bats.size());
  std::iota(all.begin(), all.end(), peer::PeerNumber{0});
  set_members(all, settings.bats);
  if (bat() != no_bat && !settings.is_late) seen_bat_ = start.game.position({bat()});
}

void SharedInterest::set_members(std::span<const peer::PeerNumber> members,
                                 std::vector<std::uint32_t> bats) {
  const std::vector<peer::PeerNumber> before =
      std::exchange(members_, {members.begin(), members.end()});
  const std::size_t count = std::max(bats.size(), is_informed_.size());
  settings_.bats = std::move(bats);
  settings_.bats.resize(count, no_bat);
  is_informed_.resize(count, false);
  keys_.set_player_count(count);
  handed_to_.resize(count, peer_.number());
  for (const peer::PeerNumber peer : before)
    if (!is_member(peer)) forget(peer);
  for (const peer::PeerNumber peer : members_)
    if (settings_.bats[peer] != no_bat && !std::binary_search(before.begin(), before.end(), peer))
      interest_.add_player(peer, settings_.bats[peer]);
}

void SharedInterest::forget(peer::PeerNumber peer) {
  interest_.remove_player(peer);
  keep_for_now(replicas_, peer, peer_.number(), parting_);
  is_informed_[peer] = false;
}

void SharedInterest::send(peer::PeerNumber to, Traffic about, rti::Bytes content) {
  std::vector<std::uint8_t> bytes(content.size());
  if (!content.empty()) std::memcpy(bytes.data(), content.data(), content.size());
  send_(to, about, std::move(bytes));
}

void SharedInterest::look_around() {
  if (!interest_.is_selective() || bat() == no_bat) return;
  bool is_new = false;
  if (const std::optional<physics::Vector2> centre = bat_place()) {
    // With cells each step counts, which sends nothing within one.
    const bool is_near =
        encoded_interest_.form == EncodedInterest::Form::region && !view_.is_left_by(*centre);
    const EncodedInterest encoded =
        is_near
            ? encoded_interest_
            : interest_at(view_.look_around(*centre, settings_.half_side), interest_.cell_size());
    is_new = encoded != encoded_interest_;
    encoded_interest_ = encoded;
  }
  if (encoded_interest_.form == EncodedInterest::Form::away) return;
  const im::Region region = region_of(encoded_interest_, interest_.cell_size());
  if (is_new) interest_.look(peer_.number(), region);
  is_new = std::exchange(is_undone_, false) || is_new;
  // Zones may have moved though the view has not.
  const SchemeReach& reach = interest_.reach();
  const peer::Box seen{region.low_x - reach.x, region.low_y - reach.y, region.high_x + reach.x,
                       region.high_y + reach.y};
  for (const peer::PeerNumber other : members_) {
    if (other == peer_.number()) continue;
    const bool is_near = division_.is_near(other, seen, 0.0);
    if (is_near && (is_new || !is_informed_[other]))
      send(other, Traffic::interest, bytes_of(encoded_interest_));
    if (!is_near && is_informed_[other])
      send(other, Traffic::interest, bytes_of(EncodedInterest{})),
          keep_for_now(replicas_, other, peer_.number(), parting_);
    is_informed_[other] = is_near;
  }
}

/// The place of the own bat, or its last known one; at first, its start. Its owner sends it to live
/// players from time to time, whatever the filter decides.
std::optional<physics::Vector2> SharedInterest::bat_place() {
  const Replica& replica = replicas_.replica(bat());
  // In a window that is cut short it may have left since places were noted.
  const bool is_here = peer_.share().owns(bat()) ||
                       std::binary_search(peer_.ghosts().begin(), peer_.ghosts().end(), bat());
  std::optional<physics::Vector2> place;
  if (is_here) place = peer_.world().position({bat()});
  else if (replica.is_there) place = replica.position_at(peer_.now());
  else
    for (const peer::Observation& observation : peer_.observations())
      if (observation.bat == bat()) place = observation.position;
  // A received place where no bat can be is ignored.
  const physics::Field& field = peer_.world().spec().field;
  if (place && place->allFinite())
    seen_bat_ = {std::clamp(place->x(), 0.0, field.length),
                 std::clamp(place->y(), 0.0, field.width)};
  return seen_bat_;
}

void SharedInterest::finish(std::uint32_t window) {
  keys_.finish_window();
  interest_.match(peer_);
  send_updates(window);
  hand_keys_over();
  keep_in_sight();
}

/// Keeps own bodies in sight that others own from now on, since these send them with the next
/// window. Ghosts are seen anyway.
void SharedInterest::keep_in_sight() {
  for (const std::uint32_t body : parted_)
    if (replicas_.replica(body).source == peer_.number()) replicas_.forget_body(body);
  parted_ = std::move(parting_);
  parting_.clear();
  if (bat() == no_bat) return;
  for (const std::uint32_t body : interest_.scope_of(peer_.number()))
    if (places_[body] == Place::own &&
        division_.owner_of(peer_.world().position({body})) != peer_.number())
      parting_.push_back(body);
  for (const std::uint32_t body : parting_)
    replicas_.assume(body, {peer_.number(), true, motion_of(body)});
}

void SharedInterest::send_updates(std::uint32_t window) {
  for (const peer::PeerNumber player : members_) {
    if (player == peer_.number() || settings_.bats[player] == no_bat) continue;
    const auto newly_felt = [&](std::uint32_t body) -> std::optional<std::uint32_t> {
      return body == settings_.bats[player] ? keys_.take_newly_felt(player) : std::nullopt;
    };
    const std::vector<std::byte> updates = interest_.updates_for(peer_, player, window, newly_felt);
    if (!updates.empty()) send(player, Traffic::updates, updates);
  }
}

/// Sends keys that came here for a bat to its new owner.
void SharedInterest::hand_keys_over() {
  for (const peer::PeerNumber player : members_) {
    const std::uint32_t bat = settings_.bats[player];
    if (bat == no_bat || places_[bat] != Place::own) continue;
    const peer::PeerNumber owner = division_.owner_of(peer_.world().position({bat}));
    if (owner == peer_.number()) continue;
    handed_to_[player] = owner;
    send_keys(owner, KeyWord::received, player, keys_.received(player));
  }
}

/// A body here is simulated and needs no replica; one that has just come counts from the next
/// decision on.
void SharedInterest::note_places() {
  replicas_.drop_forgotten();
  const std::vector<std::uint32_t> before = std::move(here_);
  here_ = peer_.owned();
  here_.insert(here_.end(), peer_.ghosts().begin(), peer_.ghosts().end());
  for (const std::uint32_t body : here_)
    if (places_[body] != Place::away) replicas_.forget_body(body);
  for (const std::uint32_t body : before) places_[body] = Place::away;
  for (const std::uint32_t body : peer_.owned()) places_[body] = Place::own;
  for (const std::uint32_t body : peer_.ghosts()) places_[body] = Place::ghost;
}

/// A message that was under way when windows were undone may come after this: so a player that
/// looks elsewhere sends that, too, to all.
void SharedInterest::begin_again(std::span<const peer::PeerNumber> members,
                                 std::vector<std::uint32_t> bats) {
  for (const peer::PeerNumber peer : members_)
    if (peer != peer_.number()) forget(peer);
  replicas_.forget(peer_.number());
  parted_.clear(), parting_.clear();
  members_ = {peer_.number()};
  set_members(members, std::move(bats));
  for (const peer::PeerNumber peer : members_) is_informed_[peer] = peer != peer_.number();
  is_undone_ = true;
  note_places();
}

peer::PeerNumber SharedInterest::owner_of_bat(peer::PeerNumber player) const {
  const std::uint32_t bat = settings_.bats[player];
  if (bat == no_bat) return player;
  if (places_[bat] == Place::own) return peer_.number();
  if (places_[bat] == Place::ghost) return division_.owner_of(peer_.world().position({bat}));
  const Replica& replica = replicas_.replica(bat);
  return replica.is_there && replica.source != peer_.number() ? replica.source : handed_to_[player];
}

void SharedInterest::press() {
  const peer::PeerNumber owner = owner_of_bat(peer_.number());
  const std::uint32_t pressed = keys_.press(peer_.number());
  if (owner != peer_.number()) send_keys(owner, KeyWord::pressed, peer_.number(), pressed);
}

void SharedInterest::send_keys(peer::PeerNumber to, KeyWord word, peer::PeerNumber player,
                               std::uint32_t count) {
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  writer.number(word);
  writer.varint(player);
  writer.varint(count);
  send(to, Traffic::keys, bytes);
}

bool SharedInterest::receive_keys(rti::Bytes content) {
  rti::Reader reader(content);
  std::uint8_t word = 0;
  peer::PeerNumber player = 0;
  std::uint32_t count = 0;
  if (!reader.range(word, 1) || !reader.varint(player) || player >= settings_.bats.size() ||
      !reader.varint(count) || !reader.is_at_end())
    return false;
  const bool is_news = keys_.receive(player, count);
  const peer::PeerNumber owner = owner_of_bat(player);
  if (is_news && player != peer_.number() && owner != peer_.number() &&
      static_cast<KeyWord>(word) == KeyWord::pressed)
    send_keys(owner, KeyWord::pressed, player, count);
  return true;
}

bool SharedInterest::receive(peer::PeerNumber from, Traffic about, rti::Bytes content) {
  if (!is_member(from)) return false;
  switch (about) {
    case Traffic::halo:
    case Traffic::claims:
    case Traffic::agreement:
    case Traffic::standby:
      return false;
    case Traffic::keys:
      return receive_keys(content);
    case Traffic::updates:
      return replicas_.receive(from, content, settings_.rate_hz);
    case Traffic::interest:
      break;
  }
  const std::optional<EncodedInterest> encoded = interest_from(content);
  if (!encoded || !interest_.is_selective() || settings_.bats[from] == no_bat) return false;
  if (encoded->form == EncodedInterest::Form::away) interest_.look_away(from);
  else interest_.look(from, region_of(*encoded, interest_.cell_size()));
  return true;
}

std::uint32_t SharedInterest::felt() const {
  if (bat() == no_bat) return 0;
  return places_[bat()] == Place::own ? std::max(keys_.felt(peer_.number()), replicas_.felt())
                                      : replicas_.felt();
}

void SharedInterest::list_scope(std::vector<std::uint32_t>& bodies) const {
  bodies.clear();
  if (bat() == no_bat) return;
  for (const std::uint32_t body : interest_.scope_of(peer_.number()))
    if (places_[body] != Place::away && !replicas_.replica(body).is_there) bodies.push_back(body);
  for (const auto& [body, replica] : replicas_.all())
    if (replica.is_there) bodies.push_back(body);
}

physics::Motion SharedInterest::motion_of(std::uint32_t body) const {
  if (places_[body] == Place::away) return replicas_.replica(body).motion;
  const physics::PartWorld& world = peer_.world();
  if (!world.is_resting({body})) return world.motion({body});
  physics::Motion still;
  still.time = world.now();
  still.position = world.position({body});
  return still;
}

physics::Vector2 SharedInterest::position_at(std::uint32_t body, double instant) const {
  if (places_[body] == Place::away) return replicas_.replica(body).position_at(instant);
  const physics::PartWorld& world = peer_.world();
  if (instant <= world.now()) return world.position({body});
  const physics::Motion motion = motion_of(body);
  return motion.at(std::max(instant, motion.time)).position;
}

}  // namespace rink::game
