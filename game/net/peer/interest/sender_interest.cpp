// Filters the bodies that are here, and makes update messages from the decisions.
#include "game/net/peer/interest/sender_interest.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/net/peer/interest/peer_replicas.h"
#include "game/replication/attributes.h"
#include "game/replication/region_sweep.h"
#include "game/replication/trajectory_codec.h"
#include "rti/wire/stream.h"

namespace rink::game {

namespace {

constexpr float coordinate_max = 1e7f;  // m, or cells

bool contains(const std::vector<std::uint32_t>& sorted, std::uint32_t value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

template <class Stream>
bool exchange(Stream& stream, EncodedInterest& encoded) {
  auto form = static_cast<std::uint8_t>(encoded.form);
  if (!stream.range(form, static_cast<std::uint8_t>(EncodedInterest::Form::cells))) return false;
  encoded.form = static_cast<EncodedInterest::Form>(form);
  if (encoded.form == EncodedInterest::Form::away) return true;
  for (float* side : {&encoded.low_x, &encoded.low_y, &encoded.high_x, &encoded.high_y}) {
    // Cells are few, so their numbers take two bytes where they fit.
    auto number = static_cast<std::int16_t>(*side);
    if (encoded.form == EncodedInterest::Form::region ? !stream.number(*side)
                                                      : !stream.number(number))
      return false;
    if (encoded.form == EncodedInterest::Form::cells) *side = number;
    if (!std::isfinite(*side) || std::abs(*side) > coordinate_max) return false;
  }
  return encoded.low_x <= encoded.high_x && encoded.low_y <= encoded.high_y;
}

}  // namespace

EncodedInterest interest_at(const im::Region& region, double cell_size) {
  const auto single = [](double value) { return static_cast<float>(value); };
  const EncodedInterest exact{EncodedInterest::Form::region, single(region.low_x),
                              single(region.low_y), single(region.high_x), single(region.high_y)};
  if (cell_size == 0.0) return exact;
  const auto cell = [cell_size](double value) {
    return static_cast<float>(std::floor(value / cell_size));
  };
  const EncodedInterest cells{EncodedInterest::Form::cells, cell(region.low_x), cell(region.low_y),
                              cell(region.high_x), cell(region.high_y)};
  const auto fits = [](float number) { return std::abs(number) < 32'000.0f; };
  return fits(cells.low_x) && fits(cells.low_y) && fits(cells.high_x) && fits(cells.high_y) ? cells
                                                                                            : exact;
}

im::Region region_of(const EncodedInterest& encoded, double cell_size) {
  const auto place = [&](float side, double within) {
    return encoded.form == EncodedInterest::Form::cells
               ? (static_cast<double>(side) + within) * cell_size
               : static_cast<double>(side);
  };
  return {place(encoded.low_x, 0.25), place(encoded.low_y, 0.25), place(encoded.high_x, 0.75),
          place(encoded.high_y, 0.75)};
}

std::vector<std::byte> bytes_of(const EncodedInterest& encoded) {
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  EncodedInterest copy = encoded;
  [[maybe_unused]] const bool is_sound = exchange(writer, copy);
  assert(is_sound);
  return bytes;
}

std::optional<EncodedInterest> interest_from(rti::Bytes bytes) {
  rti::Reader reader(bytes);
  EncodedInterest encoded;
  return exchange(reader, encoded) && reader.is_at_end() ? std::optional(encoded) : std::nullopt;
}

SenderInterest::SenderInterest(const std::string& scheme, const im::FilterSettings& settings,
                               const std::string& policy, std::vector<im::Role> roles,
                               double extent_max)
    : filter_(im::make_filter(scheme, settings)),
      world_(settings.world),
      cell_size_(scheme == "grid" ? filter_->cell_size() : 0.0),
      reach_(cell_size_ > 0.0 ? SchemeReach{extent_max + cell_size_, extent_max + cell_size_}
                              : reach_of(scheme, settings, extent_max)),
      is_selective_(scheme != "none"),
      remembers_(scheme.find("with") != std::string::npos ||
                 scheme.find("cone") != std::string::npos || filter_->traits().depends_on_crowd),
      sends_trajectories_(policy == "on-event"),
      body_roles_(std::move(roles)),
      is_here_(body_roles_.size(), 0) {
  assert(filter_ && (policy == "periodic" || policy == "on-event"));
}

void SenderInterest::add_player(peer::PeerNumber player, std::uint32_t bat) {
  if (player >= scopes_.size())
    scopes_.resize(player + 1), sent_.resize(player + 1), handed_over_.resize(player + 1),
        player_roles_.resize(player + 1);
  player_roles_[player] = body_roles_[bat];
  if (!is_selective_) look(player, world_);
}

void SenderInterest::remove_player(peer::PeerNumber player) {
  if (player < scopes_.size()) look_away(player);
}

void SenderInterest::look(peer::PeerNumber player, const im::Region& region) {
  filter_->set_subscription_region(player, region);
  filter_->set_subscriber_role(player, player_roles_[player]);
}

void SenderInterest::look_away(peer::PeerNumber player) {
  filter_->remove_subscriber(player);
  scopes_[player].clear();
  sent_[player].clear();
  handed_over_[player].clear();
}

void SenderInterest::match(const peer::Peer& peer) {
  std::vector<std::uint32_t> here = peer.owned();
  here.insert(here.end(), peer.ghosts().begin(), peer.ghosts().end());
  const physics::PartWorld& world = peer.world();
  for (const std::uint32_t body : peer.owned())
    filter_->set_update_region(body,
                               bounding_box(world.position({body}), world.half_extent({body})));
  for (const std::uint32_t body : peer.ghosts())
    filter_->set_update_region(body,
                               bounding_box(peer.known_place(body), world.half_extent({body})));
  for (const std::uint32_t body : here) {
    if (is_here_[body] == 0) filter_->set_entity_role(body, body_roles_[body]);
    is_here_[body] = 2;
  }
  bool has_lost = false;
  for (const std::uint32_t body : here_) {
    if (is_here_[body] == 2) continue;
    filter_->remove_entity(body);
    last_sent_.erase(body);
    is_here_[body] = 0;
    has_lost = true;
  }
  for (const std::uint32_t body : here) is_here_[body] = 1;
  here_ = std::move(here);
  if (has_lost)
    for (std::vector<std::uint32_t>& scope : scopes_)
      std::erase_if(scope, [this](std::uint32_t body) { return is_here_[body] == 0; });
  const std::span<const im::Change> changes = filter_->match();
  for (std::size_t first = 0, last = 0; first < changes.size(); first = last) {
    std::vector<std::uint32_t>& scope = scopes_[changes[first].subscriber];
    for (last = first;
         last < changes.size() && changes[last].subscriber == changes[first].subscriber; ++last) {
      const std::uint32_t body = changes[last].entity;
      const auto place = std::lower_bound(scope.begin(), scope.end(), body);
      const bool is_in = place != scope.end() && *place == body;
      if (changes[last].transition == im::Transition::entered && !is_in) scope.insert(place, body);
      if (changes[last].transition == im::Transition::left && is_in) scope.erase(place);
    }
  }
}

/// Decides once a window for each body in any player's scope, as a server's policy does, but
/// without work for others.
const SenderInterest::LastSent& SenderInterest::last_sent_of(const physics::PartWorld& world,
                                                             std::uint32_t body,
                                                             std::uint32_t window) {
  LastSent& last_sent = last_sent_[body];
  if (last_sent.window == window) return last_sent;
  const bool is_new = last_sent.window == 0xffffffffu ||
                      last_sent.window + 1 != window;  // others may have sent it meanwhile
  last_sent.window = window;
  if (sends_trajectories_) {
    const physics::World& here = world.inside();
    const physics::BodyId id = world.inside({body});
    last_sent.is_due = is_new || last_sent.sent.must_be_renewed(here, id);
    if (last_sent.is_due) last_sent.sent.renew(here, id);
    std::vector<std::byte> value;
    encode(value, last_sent.sent.trajectory);
    last_sent.coded.clear();
    TrajectoryCodec().encode(value, world.now(), last_sent.coded);
  } else {
    last_sent.is_due = world.kind({body}) != physics::BodyKind::post;
    encode(last_sent.coded, rounded(world.position({body})));
  }
  return last_sent;
}

std::vector<std::byte> SenderInterest::updates_for(
    const peer::Peer& peer, peer::PeerNumber player, std::uint32_t window,
    const std::function<std::optional<std::uint32_t>(std::uint32_t)>& felt) {
  using Form = BodyUpdate::Form;
  std::vector<std::byte> message;
  rti::Writer writer(message);
  const auto put = [&](std::uint32_t body, Form form, std::uint32_t felt_count, rti::Bytes motion) {
    if (message.empty()) writer.varint(window);
    std::uint64_t head = std::uint64_t{body} << 2 | static_cast<std::uint64_t>(form);
    writer.varint(head);
    if (form == Form::felt || form == Form::motion_and_felt) writer.varint(felt_count);
    if (!motion.empty()) writer.rest(motion, motion.size());
  };
  std::vector<std::uint32_t> now_sent;
  std::vector<std::uint32_t>& sent = sent_[player];
  const std::vector<std::uint32_t>& scope = scopes_[player];
  const physics::PartWorld& world = peer.world();
  for (const std::uint32_t body : peer.owned()) {
    const std::optional<std::uint32_t> newly_felt = felt(body);
    const bool is_told = contains(scope, body) && !peer.share().will_have(player, body);
    if (!is_told) {
      if (newly_felt) put(body, Form::felt, *newly_felt, {});
      continue;
    }
    now_sent.push_back(body);
    const LastSent& last_sent = last_sent_of(world, body, window);
    const bool is_due = last_sent.is_due || !contains(sent, body);
    if (is_due)
      put(body, newly_felt ? Form::motion_and_felt : Form::motion, newly_felt.value_or(0),
          last_sent.coded);
    else if (newly_felt) put(body, Form::felt, *newly_felt, {});
    motions_sent_ += is_due;
  }
  std::sort(now_sent.begin(), now_sent.end());
  // The player simulates its own bodies and ghosts itself; a body that has another owner by now,
  // and is still in scope, is sent by that owner. A scheme that remembers, or whose zones follow
  // from all bodies, may decide otherwise at the new owner, so the body is then sent as left, which
  // is ignored if the new owner has sent it. The new owner sends it first in this window, so this
  // peer does so in the next: no player loses it meanwhile.
  for (const std::uint32_t body : handed_over_[player])
    if (!contains(now_sent, body) && (remembers_ || !contains(scope, body)))
      put(body, Form::left, 0, {});
  handed_over_[player].clear();
  for (const std::uint32_t body : sent) {
    if (contains(now_sent, body)) continue;
    if (!peer.share().owns(body)) handed_over_[player].push_back(body);
    else if (!contains(scope, body)) put(body, Form::left, 0, {});
  }
  sent = std::move(now_sent);
  return message;
}

}  // namespace rink::game
