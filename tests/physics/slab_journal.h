// Parts of a scene that keep a journal, played by tiles and by the plain loop, and compared in all
// that a reader of the journal can ask.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "game/physics/subdomain.h"
#include "game/physics/world.h"
#include "tests/physics/scenes.h"
#include "tests/physics/slab_scene.h"

namespace rink::physics::test {

inline bool are_same(const BodyState& a, const BodyState& b) {
  const auto parts = [](const BodyState& s) {
    return std::tuple(s.flight.x, s.flight.y, s.flight.vx, s.flight.vy, s.flight.time,
                      s.flight.radius, s.mass, s.inverse_mass, s.impacts_begin, s.last_hop,
                      s.impacts, s.hops, s.repeats, s.repeats_instant, s.rest_time, s.spin, s.jam,
                      s.kind, s.material, s.half, s.flags, s.mouth);
  };
  return parts(a) == parts(b) && a.half_extent == b.half_extent && a.thrust == b.thrust &&
         a.acceleration == b.acceleration && a.drag == b.drag && a.slowing == b.slowing;
}

inline void expect_same(const Change& a, const Change& b) {
  ASSERT_TRUE(a.time == b.time && a.x == b.x && a.y == b.y && a.vx == b.vx && a.vy == b.vy &&
              a.since == b.since && a.conditions == b.conditions && a.body == b.body &&
              a.event == b.event && a.motion == b.motion && a.reach == b.reach)
      << a.time << ": body " << a.body << ", event " << a.event << "; " << b.time << ": body "
      << b.body << ", event " << b.event;
}

inline void expect_same(const Motion& a, const Motion& b) {
  ASSERT_TRUE(a.time == b.time && a.position == b.position && a.velocity == b.velocity &&
              a.acceleration == b.acceleration && a.drag == b.drag && a.rest_time == b.rest_time);
}

inline void expect_same(const Journal& tiles, const Journal& plain) {
  ASSERT_EQ(tiles.times, plain.times);
  ASSERT_EQ(tiles.changes.size(), plain.changes.size());
  for (std::size_t k = 0; k < plain.changes.size(); ++k) {
    expect_same(tiles.changes[k], plain.changes[k]);
    if (testing::Test::HasFatalFailure()) return;
  }
  ASSERT_EQ(tiles.event, plain.event);
  ASSERT_EQ(tiles.counted, plain.counted);
  ASSERT_EQ(tiles.quiet_events, plain.quiet_events);
  ASSERT_EQ(tiles.at_once_max, plain.at_once_max);
  ASSERT_EQ(tiles.unsolved, plain.unsolved);
  ASSERT_EQ(tiles.entered, plain.entered);
  ASSERT_EQ(tiles.rooms_of, plain.rooms_of);
  ASSERT_EQ(tiles.age, plain.age);
  ASSERT_EQ(tiles.time, plain.time);
  ASSERT_EQ(tiles.played, plain.played);
  ASSERT_EQ(tiles.thrusts.size(), plain.thrusts.size());
  ASSERT_EQ(tiles.motions.size(), plain.motions.size());
  for (std::size_t k = 0; k < plain.motions.size(); ++k) {
    expect_same(tiles.motions[k], plain.motions[k]);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// Which way an impact of two free pucks takes depends on who else is in the queue, so that more
/// may be kept of them than their flights.
inline void expect_same(const Subdomain& tiles, const Subdomain& plain) {
  expect_same(tiles.journal(), plain.journal());
  if (testing::Test::HasFatalFailure()) return;
  ASSERT_EQ(tiles.world().now(), plain.world().now());
  for (std::uint32_t body = 0; body < plain.body_count(); ++body) {
    ASSERT_EQ(tiles.is_there(body), plain.is_there(body));
    if (!plain.is_there(body)) continue;
    ASSERT_TRUE(are_same(tiles.state(body), plain.state(body))) << body;
    ASSERT_TRUE(are_same(tiles.state_before(body), plain.state_before(body))) << body;
    if (!tiles.has_flown_freely(body)) continue;
    BodyState flown = tiles.state_before(body);
    flown.flight = tiles.flight(body);
    ASSERT_TRUE(are_same(flown, tiles.state(body))) << body;
  }
  const auto a = tiles.rest_contacts(), b = plain.rest_contacts();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    ASSERT_TRUE(a[k].low == b[k].low && a[k].high == b[k].high && a[k].age == b[k].age);
  const Counters &x = tiles.world().counters(), &y = plain.world().counters();
  for (std::size_t kind = 0; kind < event_kind_names.size(); ++kind)
    ASSERT_EQ(x.*counter_of_kind[kind], y.*counter_of_kind[kind]) << event_kind_names[kind];
}

/// What it came to.
struct JournalPlay {
  SlabCounters slabs;
  std::uint64_t quiet = 0, entered = 0, changes = 0;
};

/// A part of the world as a node has one: bodies left of a line, with rooms for those deep in it.
class PartsBySlabs {
 public:
  PartsBySlabs(const World& whole, const SlabPlan& plan, std::uint64_t seed)
      : whole_(whole),
        random_(seed),
        tiles_(spec_of(whole, QueuePolicy::windows, plan), whole.body_count()),
        plain_(spec_of(whole, QueuePolicy::calendar, std::nullopt), whole.body_count()) {
    const Field& field = whole.spec().field;
    line_ = field.length * uniform(random_, 0.6, 1.1);
    for (std::uint32_t body = 0; body < whole.body_count(); ++body) {
      const BodyState state = Subdomain::state_in(whole, body);
      if (state.flight.x < line_) put(body, state);
      if (state.kind == BodyKind::bat) bats_.push_back(body);
    }
  }

  JournalPlay play(double until, int windows) {
    JournalPlay played;
    for (int window = 1; window <= windows && !testing::Test::HasFatalFailure(); ++window) {
      const double begin = tiles_.world().now(), end = until * window / windows;
      tiles_.begin_window(), plain_.begin_window();
      choose_rooms(end);
      const bool is_undone = random_() % 3 == 0;
      const std::uint64_t keys = random_();
      advance(begin, end, keys);
      if (is_undone && !testing::Test::HasFatalFailure()) {
        tiles_.undo(), plain_.undo();
        tiles_.take_entered(), plain_.take_entered();
        expect_same(tiles_, plain_);
        advance(begin, end, keys);
      }
      const Journal& journal = plain_.journal();
      played.quiet += journal.quiet_events, played.changes += journal.changes.size();
      played.entered += plain_.take_entered().size();
      tiles_.take_entered();
      exchange_some();
    }
    played.slabs = tiles_.world().counters().slabs;
    return played;
  }

 private:
  static WorldSpec spec_of(const World& whole, QueuePolicy queue,
                           const std::optional<SlabPlan>& plan) {
    WorldSpec spec = whole.spec();
    spec.queue = queue, spec.slabs = plan;
    return spec;
  }
  void put(std::uint32_t body, const BodyState& state) {
    tiles_.put(body, state), plain_.put(body, state);
  }

  /// Of whoever flies freely in one of two rooms, and stays there.
  void choose_rooms(double until) {
    const Field& field = whole_.spec().field;
    const double middle = 0.45 * field.length, rim = 0.1;
    const std::vector<Journal::Room> rooms = {{rim, rim, middle, field.width - rim},
                                              {middle, rim, line_ - 0.3, field.width - rim}};
    for (Subdomain* part : {&tiles_, &plain_}) {
      part->set_rooms(rooms, until);
      for (std::uint32_t body = 0; body < part->body_count(); ++body) {
        if (!part->is_there(body)) continue;
        std::uint8_t room = 0;
        if (const auto flight = part->free_flight(body))
          for (std::size_t k = 0; k < rooms.size(); ++k) {
            const double ahead = until - flight->time;
            if (rooms[k].holds(flight->x, flight->y) &&
                rooms[k].holds(flight->x + flight->vx * ahead, flight->y + flight->vy * ahead))
              room = static_cast<std::uint8_t>(k + 1);
          }
        part->set_room(body, room);
      }
    }
  }

  /// With keys, and stops between them.
  void advance(double begin, double end, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (int stop = 1; stop <= 3; ++stop) {
      const double until = stop == 3 ? end : begin + (end - begin) * stop / 3;
      const Vector2 thrust(uniform(random, -6.0, 6.0), uniform(random, -6.0, 6.0));
      const std::uint32_t bat = bats_.empty() ? 0 : bats_[random() % bats_.size()];
      for (Subdomain* part : {&tiles_, &plain_}) {
        if (!bats_.empty() && part->is_there(bat)) part->set_thrust(bat, thrust);
        part->advance(until);
      }
      expect_same(tiles_, plain_);
      if (testing::Test::HasFatalFailure()) return;
    }
  }

  /// Some leave, and those who left before come back where there is room; contacts stay.
  void exchange_some() {
    if (!plain_.rest_contacts().empty()) return;
    const double now = plain_.world().now();
    for (auto& [body, state] : std::exchange(away_, {})) {
      const Motion there = state.motion().at(now);
      state.flight.time = now;
      state.flight.x = there.position.x(), state.flight.y = there.position.y();
      state.flight.vx = there.velocity.x(), state.flight.vy = there.velocity.y();
      if (plain_.world().is_free(there.position, state.flight.radius + 0.01)) put(body, state);
    }
    for (std::uint32_t body = 0; body < plain_.body_count(); ++body) {
      if (!plain_.is_there(body) || random_() % 40 != 0 || !plain_.free_flight(body)) continue;
      away_.emplace_back(body, plain_.state(body));
      tiles_.drop(body), plain_.drop(body);
    }
  }

  const World& whole_;
  std::mt19937_64 random_;
  Subdomain tiles_, plain_;
  double line_ = 0.0;
  std::vector<std::uint32_t> bats_;
  std::vector<std::pair<std::uint32_t, BodyState>> away_;
};

}  // namespace rink::physics::test
