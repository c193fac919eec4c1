// Compares scopes with groups, then writes each client's message.
#include "game/replication/exact/exact_feed.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "game/physics/subdomain.h"
#include "im/basics/checked.h"
#include "rti/wire/membership_messages.h"

namespace rink::game {
namespace {

/// A conversation begins with one message, which a connection's queue must hold; no entry takes
/// fewer bytes than the latter.
constexpr std::size_t start_bytes_max = 512u << 10, entry_bytes = 12;
/// Of one client: those that rest somewhere would otherwise linger for ever.
constexpr std::size_t lingering_max = 256;

/// The place of `body`, which must be there, in a list that rises.
std::uint32_t rank_of(std::span<const std::uint32_t> bodies, std::uint32_t body) {
  const auto at = std::ranges::lower_bound(bodies, body);
  assert(at != bodies.end() && *at == body);
  return static_cast<std::uint32_t>(at - bodies.begin());
}

}  // namespace

ExactFeed::ExactFeed(const Game& game, const Scene& scene, const rti::Fom& fom, double tick_s)
    : game_(game),
      model_(fom),
      events_(game),
      hash_period_(static_cast<std::uint64_t>(std::max(1.0, std::round(1.0 / tick_s)))) {
  assert(tick_s > 0.0);
  for (const Bat& bat : scene.bodies.bats) thrusts_.push_back(bat.thrust);
  start_.spec = game.world().spec();
  start_.grid = game.network_grid().instants();
  start_.tick_s = tick_s;
}

void ExactFeed::send(const Tick& tick, rti::FederationExecution& execution) {
  events_.close(game_);
  learn(tick, execution);
  update_clients(execution);
  compare_groups();
  ++tick_count_;
  for (std::size_t k = 0; k < clients_.size(); ++k)
    if (clients_[k] && !clients_[k]->is_told) compose(k, tick, execution);
  events_.forget();
  if constexpr (checks_whole_structures) check();
}

/// Objects come and go with the publisher's last call; a slot may have another object than before.
void ExactFeed::learn(const Tick& tick, const rti::FederationExecution& execution) {
  const std::size_t count = game_.world().body_count();
  facts_.resize(count);
  knowing_.resize(count * words_);
  for (const std::uint32_t body : events_.removed()) {
    BodyFacts& facts = facts_[body];
    if (facts.slot == nobody) continue;
    for (std::size_t k = 0; k < clients_.size(); ++k)
      if (clients_[k] && knows(k, body)) {
        clients_[k]->slots.erase(facts.slot);
        know(k, body, false);
      }
    if (body_of_slot_[facts.slot] == body) body_of_slot_[facts.slot] = nobody;
    facts.slot = nobody;
  }
  for (const auto& [object, entity] : tick.publisher.registered()) {
    BodyFacts& facts = facts_[entity.id.index];
    facts = {.object = object,
             .slot = execution.slot_of(object),
             .exact_class = class_of(entity),
             .player = entity.player.value_or(0),
             .is_post = entity.kind == physics::BodyKind::post};
    if (facts.slot == rti::no_object) {
      facts.slot = nobody;
      continue;
    }
    if (body_of_slot_.size() <= facts.slot) body_of_slot_.resize(facts.slot + 1, nobody);
    body_of_slot_[facts.slot] = entity.id.index;
    if (start_.posts.empty() && start_.object_base == 0)
      start_.object_base = object.value - entity.id.index;
    if (!facts.is_post) continue;
    const Vector2 place = game_.position(entity.id);
    start_.posts.push_back({entity.id.index, facts.exact_class, place.x(), place.y()});
  }
}

std::uint32_t ExactFeed::class_of(const Entity& entity) {
  const physics::BodyState body = physics::Subdomain::state_in(game_.world(), entity.id.index);
  const ExactClass found{.kind = body.kind,
                         .team = static_cast<std::uint8_t>(entity.team),
                         .mass = body.mass,
                         .radius = body.flight.radius,
                         .half_extent = body.half_extent,
                         .thrust = entity.player ? thrusts_[*entity.player] : 0.0,
                         .material = body.material,
                         .half = body.half};
  const auto at = std::ranges::find(start_.classes, found);
  if (at == start_.classes.end()) {
    start_.classes.push_back(found);
    // Clients have the shorter list: they begin anew.
    for (std::optional<Client>& client : clients_)
      if (client) client->needs_start = true;
    return static_cast<std::uint32_t>(start_.classes.size() - 1);
  }
  return static_cast<std::uint32_t>(at - start_.classes.begin());
}

/// Who has begun to subscribe, and who has left or lets the RTI tell it all.
void ExactFeed::update_clients(rti::FederationExecution& execution) {
  std::vector<rti::FederateHandle> subscribers;
  execution.list_subscribers(model_.entity, model_.exact, subscribers);
  for (std::optional<Client>& client : clients_) {
    if (!client || std::ranges::find(subscribers, client->federate) != subscribers.end()) continue;
    execution.serve_by_host(client->federate, {});
    forget(*client);
    client.reset();
  }
  for (const rti::FederateHandle federate : subscribers) {
    const auto known = std::ranges::find_if(clients_, [&](const std::optional<Client>& each) {
      return each && each->federate == federate;
    });
    if (known != clients_.end()) {
      // It wants all of its scope again.
      if (execution.take_notice(federate)) (*known)->needs_start = true;
      continue;
    }
    auto free = std::ranges::find_if(clients_, [](const auto& each) { return !each.has_value(); });
    if (free == clients_.end()) free = clients_.emplace(clients_.end());
    free->emplace().federate = federate;
    execution.take_notice(federate);  // whatever it meant, it begins anew
    execution.serve_by_host(federate, model_.entity);
  }
  if (clients_.size() <= 64 * words_) return;
  const std::size_t former = words_, count = facts_.size();
  words_ = std::bit_ceil((clients_.size() + 63) / 64);
  std::vector<std::uint64_t> wider(count * words_);
  for (std::size_t body = 0; body < count; ++body)
    std::copy_n(knowing_.begin() + static_cast<std::ptrdiff_t>(body * former), former,
                wider.begin() + static_cast<std::ptrdiff_t>(body * words_));
  knowing_ = std::move(wider);
}

void ExactFeed::forget(Client& client) {
  const auto index = static_cast<std::size_t>(
      std::ranges::find_if(clients_, [&](const auto& each) { return each && &*each == &client; }) -
      clients_.begin());
  for (const std::uint32_t body : client.known) know(index, body, false);
  client.known.clear(), client.bats.clear(), client.lingering.clear();
  client.slots.clear();
}

void ExactFeed::know(std::size_t client, std::uint32_t body, bool is_known) {
  std::uint64_t& word = knowing_[body * words_ + client / 64];
  const std::uint64_t bit = std::uint64_t{1} << client % 64;
  word = is_known ? word | bit : word & ~bit;
}

/// Two sets of clients for each group: those who know one of its bodies, and those who know all.
void ExactFeed::compare_groups() {
  const std::span<const TickEvents::Group> groups = events_.groups();
  for (std::optional<Client>& client : clients_)
    if (client) client->partly_known.clear();
  for (std::size_t number = 0; number < groups.size(); ++number)
    for (std::size_t w = 0; w < words_; ++w) {
      std::uint64_t some = 0, all = ~std::uint64_t{0};
      for (const std::uint32_t body : groups[number].bodies) {
        const std::uint64_t knowing = knowing_[body * words_ + w];
        some |= knowing, all &= knowing;
      }
      if (groups[number].is_unforeseeable) all = 0;
      for (std::uint64_t partly = some & ~all; partly != 0; partly &= partly - 1)
        clients_[64 * w + static_cast<std::size_t>(std::countr_zero(partly))]
            ->partly_known.push_back(number);
    }
}

/// The RTI sends in parts what would be too much at once.
void ExactFeed::leave_to_rti(Client& client, rti::FederationExecution& execution) {
  forget(client);
  client.is_told = true;
  execution.serve_by_host(client.federate, {});
}

void ExactFeed::compose(std::size_t index, const Tick& tick, rti::FederationExecution& execution) {
  Client& client = *clients_[index];
  const rti::Bitmap* const scope = execution.scope(client.federate);
  assert(scope != nullptr);
  message_ = {};
  message_.time = tick.stamp.time, message_.tag = tick.stamp.tag;
  if (client.needs_start) {
    forget(client);
    client.partly_known.clear();
    client.needs_start = false;
    client.time = 0.0, client.tag = 0, client.felt = 0;
    message_.start = start_;
    ++counters_.starts;
  }
  find_changes(index, *scope);
  if (message_.start && message_.entries.size() > start_bytes_max / entry_bytes)
    return leave_to_rti(client, execution);
  add_told(client);
  end_lingering(client);
  std::ranges::sort(message_.exits, {}, &ExactExit::rank);
  add_keys(client);
  classes_.clear();
  if (!message_.told.empty() || !message_.exits.empty() || !message_.returns.empty() ||
      !message_.entries.empty())
    for (const std::uint32_t body : client.known) classes_.push_back(facts_[body].exact_class);
  const ExactContext context{.time = client.time,
                             .tag = client.tag,
                             .start = &start_,
                             .bats = static_cast<std::uint32_t>(client.bats.size()),
                             .class_of = classes_};
  drives_.assign(client.bats.size(), {});
  apply_changes(index);
  if (const auto player = tick.player_of(client.federate); player && *player < tick.felt.size())
    if (tick.felt[*player] != client.felt) message_.felt = client.felt = tick.felt[*player];
  if ((tick_count_ + index) % hash_period_ == 0 && !game_.is_cut_short()) {
    message_.hash = hash_of(client);
    ++counters_.hashes;
  }
  bytes_.clear();
  rti::BitWriter writer(bytes_);
  // A scene may have wider fields and heavier bodies than a client is told of.
  const bool is_written = exact::exchange(writer, message_, context, drives_);
  writer.finish();
  if (!is_written ||
      bytes_.size() > (message_.start ? start_bytes_max : rti::HostMessage::size_max))
    return leave_to_rti(client, execution);
  client.time = message_.time, client.tag = message_.tag;
  ++counters_.ticks, counters_.bytes += bytes_.size();
  execution.send_host_message(client.federate, bytes_);
}

/// The client's scope against what it knows: who entered, who left and who came back, by number.
/// Who left lingers: it costs a byte when it does and one when something unknown hits it, less than
/// another entry where it comes back before that, and the states of those that it hits meanwhile.
void ExactFeed::find_changes(std::size_t index, const rti::Bitmap& scope) {
  const Client& client = *clients_[index];
  entered_.clear(), left_.clear(), returned_.clear();
  const std::size_t words = std::max(scope.word_count(), client.slots.word_count());
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t bits = scope.word(w) ^ client.slots.word(w); bits != 0; bits &= bits - 1) {
      const auto slot =
          static_cast<std::uint32_t>(64 * w + static_cast<std::size_t>(std::countr_zero(bits)));
      if (slot >= body_of_slot_.size() || body_of_slot_[slot] == nobody) continue;
      const std::uint32_t body = body_of_slot_[slot];
      (!scope.contains(slot) ? left_ : knows(index, body) ? returned_ : entered_).push_back(body);
    }
  for (const std::uint32_t body : events_.removed())
    if (std::ranges::binary_search(client.known, body)) left_.push_back(body);
  std::ranges::sort(entered_), std::ranges::sort(left_), std::ranges::sort(returned_);
  for (const std::uint32_t body : left_) {
    const bool is_removed = facts_[body].slot == nobody;
    message_.exits.push_back({.rank = rank_of(client.known, body),
                              .lingers = !is_removed && !facts_[body].is_post,
                              .is_at_start = is_removed,
                              .is_removed = is_removed});
  }
  for (const std::uint32_t body : returned_)
    message_.returns.push_back(rank_of(client.known, body));
  for (const std::uint32_t body : entered_) {
    const BodyFacts& facts = facts_[body];
    message_.entries.push_back({.number = body,
                                .object = facts.object.value,
                                .exact_class = facts.exact_class,
                                .player = facts.player,
                                .state = facts.is_post ? ExactState() : state_of(body)});
  }
  counters_.entries += entered_.size(), counters_.exits += left_.size();
  counters_.returns += returned_.size();
}

ExactExit& ExactFeed::exit_of(std::uint32_t rank) {
  const auto exit = std::ranges::find(message_.exits, rank, &ExactExit::rank);
  return exit != message_.exits.end() ? *exit
                                      : message_.exits.emplace_back(ExactExit{.rank = rank});
}

/// Of groups that the client knows in part: who stays is told, who goes or lingers was never there.
void ExactFeed::add_told(const Client& client) {
  for (const std::size_t number : client.partly_known)
    for (const std::uint32_t body : events_.groups()[number].bodies) {
      if (!std::ranges::binary_search(client.known, body)) continue;
      const std::uint32_t rank = rank_of(client.known, body);
      const bool stays = !std::ranges::binary_search(left_, body) &&
                         (std::ranges::find(client.lingering, body) == client.lingering.end() ||
                          std::ranges::binary_search(returned_, body));
      if (stays) {
        message_.told.push_back({rank, state_of(body)});
        continue;
      }
      ExactExit& exit = exit_of(rank);
      exit.lingers = false, exit.is_at_start = true;
    }
  std::ranges::sort(message_.told, {}, &ExactTold::rank);
  counters_.told += message_.told.size();
}

/// Too many linger: those that have done so longest end.
void ExactFeed::end_lingering(const Client& client) {
  const auto coming =
      static_cast<std::size_t>(std::ranges::count_if(message_.exits, &ExactExit::lingers));
  std::size_t many = client.lingering.size() + coming;
  for (const std::uint32_t body : client.lingering) {
    if (many-- <= lingering_max) return;
    if (std::ranges::binary_search(returned_, body)) continue;
    exit_of(rank_of(client.known, body));
  }
}

void ExactFeed::add_keys(const Client& client) {
  for (const DriveChange& change : events_.drive_changes())
    if (std::ranges::binary_search(client.bats, change.bat))
      message_.keys.push_back(
          {change.time, rank_of(client.bats, change.bat), change.before, change.after});
  counters_.keys += message_.keys.size();
}

void ExactFeed::apply_changes(std::size_t index) {
  Client& client = *clients_[index];
  const auto is_bat = [this](std::uint32_t body) {
    return start_.classes[facts_[body].exact_class].kind == physics::BodyKind::bat;
  };
  left_.clear();
  for (const ExactExit& exit : message_.exits) {
    const std::uint32_t body = client.known[exit.rank];
    if (facts_[body].slot != nobody) client.slots.erase(facts_[body].slot);
    if (exit.lingers) client.lingering.push_back(body);
    else left_.push_back(body);
  }
  for (const std::uint32_t body : left_) {
    client.known.erase(std::ranges::lower_bound(client.known, body));
    if (is_bat(body)) client.bats.erase(std::ranges::lower_bound(client.bats, body));
    std::erase(client.lingering, body);
    if (facts_[body].slot != nobody) know(index, body, false);  // or the object is gone
  }
  for (const std::uint32_t body : returned_) {
    std::erase(client.lingering, body);
    client.slots.insert(facts_[body].slot);
  }
  for (const std::uint32_t body : entered_) {
    client.known.insert(std::ranges::lower_bound(client.known, body), body);
    if (is_bat(body)) client.bats.insert(std::ranges::lower_bound(client.bats, body), body);
    client.slots.insert(facts_[body].slot);
    know(index, body, true);
  }
}

ExactState ExactFeed::state_of(std::uint32_t body) const {
  const physics::World& world = game_.world();
  ExactState state{.body = physics::Subdomain::state_in(world, body),
                   .drive = events_.drive_of(body),
                   .rest_contacts = {},
                   .jammed_with = {}};
  if (physics::Subdomain::is_held_along(state.body, 0) ||
      physics::Subdomain::is_held_along(state.body, 1))
    for (const physics::RestContact& rest : physics::WorldJournal::rest_contacts(world))
      if (rest.low == body || rest.high == body) state.rest_contacts.push_back(rest);
  if (physics::Subdomain::is_frozen(state.body))
    for (const auto& [other, jam] : physics::WorldJournal::jams(world))
      if (jam == state.body.jam && other != body) state.jammed_with.push_back(other);
  return state;
}

std::uint32_t ExactFeed::hash_of(const Client& client) const {
  std::uint64_t sum = 0;
  for (const std::uint32_t body : client.known)
    if (!facts_[body].is_post)
      sum += digest_of(body, physics::Subdomain::state_in(game_.world(), body));
  return static_cast<std::uint32_t>(sum >> 32);
}

void ExactFeed::check() const {
  for (std::size_t k = 0; k < clients_.size(); ++k) {
    if (!clients_[k]) continue;
    const Client& client = *clients_[k];
    assert(std::ranges::is_sorted(client.known) && std::ranges::is_sorted(client.bats));
    for (const std::uint32_t body : client.known)
      assert(knows(k, body) &&
             client.slots.contains(facts_[body].slot) ==
                 (std::ranges::find(client.lingering, body) == client.lingering.end()));
    std::size_t count = client.lingering.size();
    client.slots.for_each([&](std::uint32_t) { ++count; });
    assert(count == client.known.size());
  }
}

}  // namespace rink::game
