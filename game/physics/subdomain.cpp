// Bodies put into slots and taken from them, and windows undone.
#include "game/physics/subdomain.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "game/physics/body_hash.h"
#include "game/physics/engine/engine.h"
#include "game/physics/world_journal.h"
#include "im/basics/checked.h"

namespace rink::physics::inline RINK_PRECISION {

std::uint64_t most_at_once(std::span<const double> times) {
  constexpr double roundings =
      32.0;  // twice as long as the engine's instant, for times may be some roundings out of order
  std::size_t most = 0, first = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    while (times[first] + roundings * std::numeric_limits<double>::epsilon() * (1.0 + times[k]) <
           times[k])
      ++first;
    assert(first <= k);
    most = std::max(most, k - first + 1);
  }
  return most;
}

namespace {

/// `count` slots without bodies.
WorldState blank_state(const WorldSpec& spec, std::size_t count) {
  WorldState blank;
  blank.spec = spec;
  const BodyShape nothing{1.0, 0.0, Vector2(0.0, 0.0), Vector2(0.0, 0.0), Half::both};
  blank.bodies.bodies.assign(
      count,
      {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0, BodyKind::puck, 0, Body::removed, Body::no_mouth});
  blank.bodies.shapes.assign(count, nothing);
  blank.bodies.laws.assign(count, {Vector2(0.0, 0.0), Vector2::Constant(spec.puck_drag)});
  if (spec.puck_friction > 0.0) {
    blank.bodies.rest_times.assign(count, infinity);
    blank.bodies.slowing.assign(count, Vector2(0.0, 0.0));
  }
  if (spec.surface_friction) blank.bodies.spins.assign(count, 0.0);
  blank.impact_counts.resize(count);
  blank.jams.numbers.assign(count, 0);
  blank.ledger = EnergyLedger(spec.accounts_energy);
  return blank;
}

/// Of each body its record from where it was; the others stay blank.
template <class Records>
void take_records(Records& to, const Records& from, const std::vector<std::uint32_t>& slots) {
  assert(to.empty() == from.empty());
  for (std::size_t slot = 0; slot < to.size(); ++slot)
    if (slots[slot] != BodySlots::nobody) to[slot] = from[slots[slot]];
}

/// With each body in another slot: `slots` says where it was.
WorldState spread_state(WorldState before, const std::vector<std::uint32_t>& slots) {
  WorldState state = blank_state(before.spec, slots.size());
  take_records(state.bodies.bodies, before.bodies.bodies, slots);
  take_records(state.bodies.shapes, before.bodies.shapes, slots);
  take_records(state.bodies.laws, before.bodies.laws, slots);
  take_records(state.bodies.rest_times, before.bodies.rest_times, slots);
  take_records(state.bodies.slowing, before.bodies.slowing, slots);
  take_records(state.bodies.spins, before.bodies.spins, slots);
  take_records(state.impact_counts, before.impact_counts, slots);
  take_records(state.jams.numbers, before.jams.numbers, slots);
  std::vector<Partner> places(before.impact_counts.size(), partner::none);
  for (std::size_t slot = 0; slot < slots.size(); ++slot)
    if (slots[slot] != BodySlots::nobody) places[slots[slot]] = static_cast<Partner>(slot);
  const auto now_at = [&](Partner p) { return is_body(p) ? places[p] : p; };
  for (const std::uint32_t body : before.jams.frozen)
    if (places[body] != partner::none) state.jams.frozen.push_back(places[body]);
  state.jams.count = before.jams.count;
  state.rest_contacts = std::move(before.rest_contacts);
  for (RestContact& rest : state.rest_contacts)
    rest.low = now_at(rest.low), rest.high = now_at(rest.high);
  std::erase_if(state.rest_contacts, [](const RestContact& rest) {
    return rest.low == partner::none || rest.high == partner::none;  // of who was dropped
  });
  state.clock = before.clock, state.counters = before.counters, state.ledger = before.ledger;
  return state;
}

/// These contacts with other names for bodies.
template <class Named>
std::vector<RestContact> renamed(std::vector<RestContact> rest_contacts, Named&& named) {
  for (RestContact& rest : rest_contacts)
    for (Partner* const p : {&rest.low, &rest.high})
      if (is_body(*p)) *p = named(*p);
  return rest_contacts;
}

/// Whose next event is with the body.
void add_waiting_for(std::uint32_t body, Engine& engine, std::vector<std::uint32_t>& waiting) {
  const Engine::Parts parts = engine.parts();
  if (!parts.places.grid().is_listed(body)) return;
  parts.places.grid().around(body, [&](std::uint32_t other) {
    if (parts.events[other].partner == body) waiting.push_back(other);
  });
}

/// For the engine, they go and others come. Whoever waits for one of them would find that it has
/// gone, as others meet at that instant.
void move_bodies(const BodySlots::Room& room, Engine& engine, Journal& journal) {
  std::vector<RestContact> rest_contacts = engine.rest_contacts();
  std::vector<std::uint32_t> waiting;
  BodySlots::visit_moves(room, [&](std::uint32_t from, std::uint32_t to) {
    add_waiting_for(from, engine, waiting);
    engine.put(to, engine.body_state(from));
    engine.drop(from);
    journal.rooms_of[to] = std::exchange(journal.rooms_of[from], std::uint8_t{0});
    rest_contacts =
        renamed(std::move(rest_contacts), [&](Partner p) { return p == from ? Partner{to} : p; });
  });
  if (!rest_contacts.empty()) engine.set_rest_contacts(std::move(rest_contacts));
  for (const std::uint32_t body : waiting)
    if (!engine.bodies()[body].is(Body::gone)) engine.require_prediction(body);
}

}  // namespace

Subdomain::Subdomain(const WorldSpec& spec, std::uint32_t body_count)
    : slots_(body_count), world_(spec), part_(world_, slots_) {
  assert(body_count <= partner::field_parts);
  engine().restore(blank_state(spec, slots_.slot_count()));
  journal_.rooms_of.assign(slots_.slot_count(), 0);
  observe();
}

/// The engine is new, and undoes nothing that was before.
void Subdomain::observe() {
  before_.emplace(engine().images(slots_.slot_count()));
  journal_.numbers = slots_.numbers();
  engine().observe({&*before_, &journal_});
}

Subdomain::~Subdomain() { engine().observe({}); }

BodyState Subdomain::state_in(const World& world, std::uint32_t body) {
  assert(body < world.body_count());
  return world.engine_->body_state(body);
}

std::uint64_t hash_of(const Subdomain& part) {
  const WorldSpec& spec = part.world().spec();
  BodyHash hash;
  for (std::uint32_t body = 0; body < part.body_count(); ++body) {
    const BodyState s = part.state(body);
    const bool is_straight = s.kind != BodyKind::bat && s.acceleration == RealVector(0.0, 0.0) &&
                             s.drag == RealVector::Constant(spec.puck_drag);
    hash.add(s.flight, is_straight ? nullptr : &s.acceleration, is_straight ? nullptr : &s.drag,
             s.flags, spec.surface_friction ? std::optional<Real>(s.spin) : std::nullopt);
  }
  return hash.value();
}

void Subdomain::show_instant(World& world, double now) {
  assert(now >= world.now());
  world.engine_->parts().clock.arrive(now);
}

void Subdomain::show(World& world, std::uint32_t body, const BodyState& state) {
  assert(body < world.body_count() && state.flight.time <= world.now());
  world.engine_->put(body, state);
}

Motion Subdomain::motion_before(std::uint32_t body) const {
  return before_->has_changed(slot(body)) ? state_before(body).motion()
                                          : engine().bodies().motion(slot(body));
}

const Flight& Subdomain::flight(std::uint32_t body) const { return engine().bodies()[slot(body)]; }

std::optional<Flight> Subdomain::free_flight(std::uint32_t body) const {
  const Body& b = engine().bodies()[slot(body)];
  if (b.is(Body::curved | Body::lasting)) return std::nullopt;
  return b;
}

bool Subdomain::was_gone(std::uint32_t body) const {
  return (before_->flags(slot(body)) & Body::gone) != 0;
}

bool Subdomain::is_possible(const BodyState& state, std::uint32_t body_count) {
  constexpr std::uint8_t known = Body::lasting & ~Body::removed;
  return (state.flags & ~known) == 0 && state.mouth <= Body::right_mouth &&
         (!is_frozen(state) || state.jam < body_count);
}

double Subdomain::glide_max(const WorldSpec& spec) {
  return static_cast<double>(physics::glide_max(spec));
}

bool Subdomain::is_out_of_play(const BodyState& state) { return (state.flags & Body::gone) != 0; }

bool Subdomain::is_frozen(const BodyState& state) { return (state.flags & Body::frozen) != 0; }

bool Subdomain::is_held_along(const BodyState& state, int axis) {
  assert(axis == 0 || axis == 1);
  return (state.flags & Body::held_along(axis)) != 0;
}

void release(BodyState& state, int axis) {
  assert(axis == 0 || axis == 1);
  state.flags = static_cast<std::uint8_t>(state.flags & ~Body::held_along(axis));
}

void Subdomain::put(std::uint32_t body, const BodyState& state) {
  std::uint32_t place = slot(body);
  if (place == BodySlots::nobody) place = make_room(body);  // perhaps in a new engine
  engine().put(place, state);
}

void Subdomain::drop(std::uint32_t body) {
  const std::uint32_t place = slot(body);
  if (place == BodySlots::nobody) return;
  journal_.rooms_of[place] = 0;
  engine().drop(place);
  slots_.release(body);
  has_dropped_ = true;
}

/// Contacts name slots: one of a dropped body would become that of whoever comes into its slot.
std::uint32_t Subdomain::make_room(std::uint32_t body) {
  if (std::exchange(has_dropped_, false) && !engine().rest_contacts().empty())
    engine().drop_blank_contacts();
  std::optional<BodySlots::Room> room = slots_.room_for(body);
  if (!room) spread(body), room = slots_.room_for(body);
  assert(room);
  if (room->slot != room->blank) move_bodies(*room, engine(), journal_);
  slots_.take(body, *room);
  return room->slot;
}

/// Rare, and as much work as an undone window.
void Subdomain::spread(std::uint32_t body) {
  WorldState before = engine().state();
  const std::vector<std::uint32_t> slots = slots_.spread(body);
  WorldState state = spread_state(std::move(before), slots);
  world_ = World(state.spec);
  engine().restore(std::move(state));
  std::vector<std::uint8_t> rooms(slots.size(), 0);
  take_records(rooms, journal_.rooms_of, slots);
  journal_.rooms_of = std::move(rooms);
  observe();
  if constexpr (checks_whole_structures) slots_.check();
}

std::vector<RestContact> Subdomain::rest_contacts() const {
  return renamed(engine().rest_contacts(), [this](Partner p) { return number_of(p); });
}

std::vector<RestContact> Subdomain::rest_contacts_before() const {
  return renamed(mark_.rest_contacts, [this](Partner p) { return number_of(p); });
}

void Subdomain::set_rest_contacts(std::vector<RestContact> rest_contacts) {
  assert(std::ranges::all_of(rest_contacts, [this](const RestContact& rest) {
    return (!is_body(rest.low) || is_there(rest.low)) &&
           (!is_body(rest.high) || is_there(rest.high));
  }));
  engine().set_rest_contacts(
      renamed(std::move(rest_contacts), [this](Partner p) { return slot(p); }));
}

std::vector<std::uint32_t> Subdomain::group_of(std::uint32_t body) const {
  std::vector<std::uint32_t> group = engine().group_of(slot(body));
  for (std::uint32_t& member : group) member = number_of(member);
  return group;
}

/// Where many came in order, or many went, there are more blank slots than anybody needs.
void Subdomain::begin_window() {
  if (slots_.slot_count() > slots_.count() + slots_.count() / 4 + 64) spread(0);
  before_->begin();
  journal_.changes.clear(), journal_.motions.clear(), journal_.sight.clear();
  journal_.thrusts.clear();
  journal_.event = 0, journal_.quiet_events = 0, journal_.mixed_digest = 0,
  journal_.at_once_max = 0;
  journal_.times.clear(), journal_.counted.clear(), journal_.unsolved.clear();
  mark_ = engine().mark();
}

void Subdomain::undo() {
  engine().undo(mark_, *before_);
  begin_window();
}

void Subdomain::advance(double until) {
  while (world_.advance(until)) {
  }
}

void Subdomain::advance(double until, Halves& halves) {
  while (halves.advance(world_, part_, until, nullptr)) {
  }
  assert(world_.now() == until && "windows end where a stay does");
}

void WorldJournal::observe(World& world) {
  journal_ = {};
  journal_.rooms_of.assign(world.body_count(), 0);
  world.engine_->observe({nullptr, &journal_});
}

void WorldJournal::detach(World& world) { world.engine_->observe({}); }

void WorldJournal::forget() {
  journal_.changes.clear(), journal_.motions.clear(), journal_.sight.clear();
  journal_.thrusts.clear();
  journal_.event = 0, journal_.mixed_digest = 0, journal_.at_once_max = 0;
  journal_.times.clear(), journal_.counted.clear(), journal_.unsolved.clear();
}

const std::vector<RestContact>& WorldJournal::rest_contacts(const World& world) {
  return world.engine_->rest_contacts();
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> WorldJournal::jams(const World& world) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> jams;
  const JamTable& table = world.engine_->parts().jams.table();
  for (const std::uint32_t body : table.frozen) jams.emplace_back(body, table.numbers[body]);
  return jams;
}

}  // namespace rink::physics::inline RINK_PRECISION
