// Windows as their ends come, and around them where the player looks, what others are told, and keys.
#include "game/net/peer/peer_node.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "rti/wire/stream.h"

namespace rink::game {

namespace {

Traffic traffic_of(peer::Subject about) {
  switch (about) {
    case peer::Subject::claims: return Traffic::claims;
    case peer::Subject::verdict: return Traffic::agreement;
    case peer::Subject::arrivals: break;
  }
  return Traffic::halo;
}

std::vector<physics::BodyKind> kinds_of(const Game& game) {
  std::vector<physics::BodyKind> kinds(game.world().body_count(), physics::BodyKind::puck);
  for (const Entity& entity : game.entities()) kinds[entity.id.index] = entity.kind;
  return kinds;
}

Drag drag_of(const physics::WorldSpec& spec) { return {.pucks = spec.puck_drag, .bats = spec.bat_drag, .puck_friction = spec.puck_friction}; }

}  // namespace

SeatedDivision seated_division(const Game& start, peer::PeerNumber peer_count) {
  assert(peer_count <= start.player_count());
  std::vector<Vector2> places;
  for (peer::PeerNumber player = 0; player < peer_count; ++player) places.push_back(start.position(*start.bat(player)));
  SeatedDivision seated{peer::Division::by_count(start.world().spec().field, places, peer_count), std::vector<std::uint32_t>(peer_count)};
  std::vector<bool> is_taken(peer_count, false);
  std::vector<std::uint32_t> others;
  for (peer::PeerNumber player = 0; player < peer_count; ++player) {
    const peer::PeerNumber owner = seated.division.owner_of(places[player]);
    const std::uint32_t bat = start.bat(player)->index;
    if (is_taken[owner]) others.push_back(bat);
    else is_taken[owner] = true, seated.bats[owner] = bat;
  }
  // Bats in one line cannot always be cut apart.
  for (peer::PeerNumber peer = 0; peer < peer_count; ++peer)
    if (!is_taken[peer]) seated.bats[peer] = others.back(), others.pop_back();
  return seated;
}

PeerNode::PeerNode(const SharedGame& game, const NodeSettings& settings, const peer::Division& division, peer::PeerNumber number, Send send)
    : settings_(settings),
      division_(division),
      send_(std::move(send)),
      peer_(game.peer(division, number, 1.0 / settings.rate_hz)),
      play_(*peer_, division.peer_count(), [this](peer::PeerNumber to, peer::Subject about, std::vector<std::uint8_t> bytes) { say(to, traffic_of(about), std::move(bytes)); }),
      interest_(settings.scheme, settings.cell_size, settings.policy, game.start().world().spec().field, division.peer_count(), game.start().world().body_count()),
      picture_(game.start().world().body_count(), interest_.tells_trajectories(), drag_of(game.start().world().spec()), kinds_of(game.start())),
      places_(game.start().world().body_count(), Place::away),
      is_told_(division.peer_count(), false),
      heard_(division.peer_count(), 0),
      playing_(heard_),
      felt_(heard_),
      told_felt_(heard_),
      handed_to_(division.peer_count(), number) {
  for (const Entity& entity : game.start().entities()) extent_max_ = std::max(extent_max_, entity.half_extent.maxCoeff());
  play_.on_final = [this] { finish(); };
  play_.on_commit = [this] {
    note_places();
    if (on_commit) on_commit();
    if (waiting_ > 0) --waiting_, play_next();
  };
  peer_->begin(end_of(1));
  note_places();
}

void PeerNode::say(peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> content) {
  sent_[static_cast<std::size_t>(about)] += content.size();
  ++messages_sent_[static_cast<std::size_t>(about)];
  send_(to, about, std::move(content));
}

void PeerNode::say(peer::PeerNumber to, Traffic about, rti::Bytes content) {
  std::vector<std::uint8_t> bytes(content.size());
  if (!content.empty()) std::memcpy(bytes.data(), content.data(), content.size());
  say(to, about, std::move(bytes));
}

void PeerNode::due() {
  if (is_idle()) play_next();
  else ++waiting_;
}

void PeerNode::play_next() {
  playing_ = heard_;
  ++begun_;
  play_.begin(end_of(begun_ + 1));
  look_around();
}

/// After the run of a window, before it is agreed upon: so that others know where the player looks when they tell of this window. A view need not be exact.
void PeerNode::look_around() {
  if (!interest_.is_selective()) return;
  if (const std::optional<physics::Vector2> centre = bat_place()) {
    const double reach = settings_.half_side + settings_.margin;
    const im::Region region{centre->x() - reach, centre->y() - reach, centre->x() + reach, centre->y() + reach};
    const physics::Vector2 before{0.5 * (static_cast<double>(gaze_.low_x) + static_cast<double>(gaze_.high_x)), 0.5 * (static_cast<double>(gaze_.low_y) + static_cast<double>(gaze_.high_y))};
    const bool is_near = gaze_.form == Gaze::Form::region && settings_.margin > 0.0 && (*centre - before).cwiseAbs().maxCoeff() < 0.5 * settings_.margin;
    const Gaze gaze = is_near ? gaze_ : gaze_at(region, interest_.cell_size());
    if (gaze == gaze_) return;
    gaze_ = gaze;
  }
  if (gaze_.form == Gaze::Form::away) return;
  const im::Region region = region_of(gaze_, interest_.cell_size());
  interest_.look(peer_->number(), region);
  // Cells that are touched count whole.
  const double grown = extent_max_ + interest_.cell_size();
  for (peer::PeerNumber other = 0; other < division_.peer_count(); ++other) {
    if (other == peer_->number()) continue;
    const bool is_near = division_.is_near(other, {region.low_x, region.low_y, region.high_x, region.high_y}, grown);
    if (is_near) say(other, Traffic::interest, bytes_of(gaze_));
    if (!is_near && is_told_[other]) say(other, Traffic::interest, bytes_of(Gaze{})), picture_.forget(other);
    is_told_[other] = is_near;
  }
}

std::optional<physics::Vector2> PeerNode::bat_place() const {
  if (places_[bat()] != Place::away) return peer_->world().position({bat()});
  const Belief& belief = picture_.belief(bat());
  return belief.is_there ? std::optional(belief.position_at(now())) : std::nullopt;
}

/// Everybody has accepted.
void PeerNode::finish() {
  ++final_;
  felt_ = playing_;
  interest_.match(*peer_);
  tell();
  hand_keys_over();
  if (on_final) on_final();
}

void PeerNode::tell() {
  for (peer::PeerNumber player = 0; player < division_.peer_count(); ++player) {
    if (player == peer_->number()) continue;
    const auto newly_felt = [&](std::uint32_t body) -> std::optional<std::uint32_t> {
      if (body != settings_.bats[player] || felt_[player] <= told_felt_[player]) return std::nullopt;
      return told_felt_[player] = felt_[player];
    };
    const std::vector<std::byte> updates = interest_.updates_for(*peer_, player, final_, newly_felt);
    if (!updates.empty()) say(player, Traffic::updates, updates);
  }
}

/// To who owns a bat from now on, what came for it here.
void PeerNode::hand_keys_over() {
  for (peer::PeerNumber player = 0; player < division_.peer_count(); ++player) {
    const std::uint32_t bat = settings_.bats[player];
    if (places_[bat] != Place::own) continue;
    const peer::PeerNumber owner = division_.owner_of(peer_->world().position({bat}));
    if (owner == peer_->number()) continue;
    handed_to_[player] = owner;
    say_keys(owner, KeyWord::heard, player, heard_[player]);
  }
}

/// Who is here is seen, not told; who has just come only from the next decision on, in which it takes part.
void PeerNode::note_places() {
  const std::vector<std::uint32_t> before = std::move(here_);
  here_ = peer_->owned();
  here_.insert(here_.end(), peer_->ghosts().begin(), peer_->ghosts().end());
  for (const std::uint32_t body : here_)
    if (places_[body] != Place::away) picture_.forget_body(body);
  for (const std::uint32_t body : before) places_[body] = Place::away;
  for (const std::uint32_t body : peer_->owned()) places_[body] = Place::own;
  for (const std::uint32_t body : peer_->ghosts()) places_[body] = Place::ghost;
}

peer::PeerNumber PeerNode::owner_of_bat(peer::PeerNumber player) const {
  const std::uint32_t bat = settings_.bats[player];
  if (places_[bat] == Place::own) return peer_->number();
  if (places_[bat] == Place::ghost) return division_.owner_of(peer_->world().position({bat}));
  const Belief& belief = picture_.belief(bat);
  return belief.is_there ? belief.source : handed_to_[player];
}

void PeerNode::press() {
  ++pressed_;
  const peer::PeerNumber owner = owner_of_bat(peer_->number());
  heard_[peer_->number()] = pressed_;
  if (owner != peer_->number()) say_keys(owner, KeyWord::pressed, peer_->number(), pressed_);
}

void PeerNode::say_keys(peer::PeerNumber to, KeyWord word, peer::PeerNumber player, std::uint32_t count) {
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  writer.number(word);
  writer.varint(player);
  writer.varint(count);
  say(to, Traffic::keys, bytes);
}

bool PeerNode::hear_keys(rti::Bytes content) {
  rti::Reader reader(content);
  std::uint8_t word = 0;
  peer::PeerNumber player = 0;
  std::uint32_t count = 0;
  if (!reader.range(word, 1) || !reader.varint(player) || player >= division_.peer_count() || !reader.varint(count) || !reader.is_at_end()) return false;
  const bool is_news = count > heard_[player];
  heard_[player] = std::max(heard_[player], count);
  const peer::PeerNumber owner = owner_of_bat(player);
  if (is_news && player != peer_->number() && owner != peer_->number() && static_cast<KeyWord>(word) == KeyWord::pressed) say_keys(owner, KeyWord::pressed, player, count);
  return true;
}

bool PeerNode::hear(peer::PeerNumber from, Traffic about, std::vector<std::uint8_t> content) {
  const rti::Bytes bytes = std::as_bytes(std::span(content));
  switch (about) {
    case Traffic::halo:
    case Traffic::claims:
    case Traffic::agreement: play_.hear(from, std::move(content)); return true;
    case Traffic::keys: return hear_keys(bytes);
    case Traffic::updates: return picture_.hear(from, bytes, settings_.rate_hz);
    case Traffic::interest: break;
  }
  const std::optional<Gaze> gaze = gaze_from(bytes);
  if (!gaze || !interest_.is_selective()) return false;
  if (gaze->form == Gaze::Form::away) interest_.look_away(from);
  else interest_.look(from, region_of(*gaze, interest_.cell_size()));
  return true;
}

std::uint32_t PeerNode::felt() const { return places_[bat()] == Place::own ? std::max(felt_[peer_->number()], picture_.felt()) : picture_.felt(); }

void PeerNode::list_scope(std::vector<std::uint32_t>& bodies) const {
  bodies.clear();
  for (const std::uint32_t body : interest_.scope_of(peer_->number()))
    if (places_[body] != Place::away && !picture_.belief(body).is_there) bodies.push_back(body);
  for (std::uint32_t body = 0; body < picture_.body_count(); ++body)
    if (picture_.belief(body).is_there) bodies.push_back(body);
}

physics::Vector2 PeerNode::position_at(std::uint32_t body, double instant) const {
  if (places_[body] == Place::away) return picture_.belief(body).position_at(instant);
  const physics::World& world = peer_->world();
  if (instant <= world.now() || world.is_resting({body})) return world.position({body});
  const physics::Motion motion = world.motion({body});
  return motion.at(std::max(instant, motion.time)).position;
}

}  // namespace rink::game
