// Residuals between the RTI and its federates: whatever enters, leaves, is held back or subscribed
// anew, every federate has the owner's values, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <random>

#include "game/replication/attributes.h"
#include "game/replication/trajectory.h"
#include "game/replication/trajectory_residual.h"
#include "rti/federation_execution.h"
#include "tests/net/residuals/watchers.h"

namespace rink::game::residuals {
namespace {

using physics::Vector2;

/// An RTI with one owner of entities and some that watch; the latter behind a storm, if there is
/// one.
struct Session final : rti::Outlet {
  rti::FederationExecution execution;
  std::deque<Watcher> watchers;
  std::optional<Storm> storm;
  double clock = 0.0;
  bool is_over = false;
  explicit Session(const char* filter, std::optional<unsigned> storm_seed = std::nullopt)
      : execution(rink_fom(), settings(filter)) {
    if (storm_seed) storm.emplace(*storm_seed);
  }
  static rti::FederationSettings settings(const char* filter) {
    rti::FederationSettings settings;
    settings.filter = filter;
    return settings;
  }
  Watcher& enter() {
    const auto number = static_cast<rti::ConnectionId>(watchers.size());
    Watcher& watcher = watchers.emplace_back();
    execution.connect(number);
    watcher.ambassador.join("rink", "watcher " + std::to_string(number), "");
    if (is_stormy(number)) watcher.ambassador.expect_datagrams(datagram_max(number));
    is_over = true;
    for (int i = 0; i < 3; ++i) tick();
    is_over = false;
    return watcher;
  }
  bool is_stormy(rti::ConnectionId connection) const { return storm && connection != 0; }
  std::size_t datagram_max(rti::ConnectionId connection) const override {
    return is_stormy(connection) ? 1191 : 0;
  }
  void send_datagrams(rti::ConnectionId connection,
                      std::span<const rti::Datagram> datagrams) override {
    for (const rti::Datagram& each : datagrams) storm->send(watchers[connection], each);
  }
  void send(rti::ConnectionId connection, std::span<const rti::Bytes> parts) override {
    if (is_stormy(connection)) return storm->send(watchers[connection], parts);
    for (const rti::Bytes part : parts)
      ASSERT_TRUE(watchers[connection].ambassador.receive(part)) << "connection " << connection;
  }
  void drop(rti::ConnectionId connection, std::string_view why) override {
    ADD_FAILURE() << "connection " << connection << ": " << why;
  }
  std::size_t waiting_bytes(rti::ConnectionId connection) const override {
    return watchers[connection].is_reading ? 0 : std::size_t{1} << 20;
  }
  void tick() {
    clock += 1.0 / 60.0;
    execution.advance_clock(clock);
    if (storm) storm->deliver(is_over);
    for (rti::ConnectionId id = 0; id < watchers.size(); ++id) {
      rti::Ambassador& ambassador = watchers[id].ambassador;
      ambassador.advance_clock(clock);
      execution.receive(id, ambassador.outgoing());
      ambassador.clear_outgoing();
      for (const rti::Datagram& each : ambassador.outgoing_datagrams()) {
        Values bytes(each.head.begin(), each.head.end());
        bytes.insert(bytes.end(), each.body.begin(), each.body.end());
        execution.receive_datagram(id, bytes);
      }
      ambassador.clear_outgoing_datagrams();
    }
    execution.match();
    execution.flush(*this);
  }
};

/// Random updates of entities by their owner, and random interests of the others.
class Play {
 public:
  Play(unsigned seed, const char* filter, std::optional<unsigned> storm_seed = std::nullopt)
      : random_(seed), session_(filter, storm_seed), is_quiet_(seed % 2 == 1) {
    Watcher& owner = session_.enter();
    owner.ambassador.publish_object_class_attributes(
        rink_model().entity,
        {rink_model().shape, rink_model().input, rink_model().trajectory, rink_model().position});
    for (int k = 0; k < 3; ++k) {
      Watcher& watcher = session_.enter();
      watcher.region = watcher.ambassador.create_region();
      look(watcher);
      watcher.ambassador.commit_region_modifications(watcher.region);
      subscribe(watcher, every());
    }
    if (seed % 4 >= 2) constrain(session_.watchers.back());
    while (objects_.size() < 6) add();
  }

  void tick() {
    now_ += 1.0 / 60.0;
    for (std::size_t k = 0; k < objects_.size(); ++k)
      for (unsigned times = is_quiet_ && below(8) != 0 ? 0 : below(3); times > 0; --times)
        update(k);
    for (unsigned times = is_quiet_ ? below(16) / 15 : below(4); times > 0; --times) hit();
    if (below(20) == 0) replace(below(static_cast<unsigned>(objects_.size())));
    is_settled_ = false;
    for (std::size_t k = 1; k < session_.watchers.size(); ++k) change(session_.watchers[k], k > 1);
    ask(30);
    session_.tick();
    ++ticks_;
  }
  /// Every watcher that reads has the newest value of what it subscribes to, of all in its scope.
  void compare() const {
    for (std::size_t k = 1; k < session_.watchers.size(); ++k) {
      const Watcher& watcher = session_.watchers[k];
      if (!watcher.is_reading || (&watcher == constrained_ && !is_settled_)) continue;
      for (const Owned& each : objects_) {
        if (!watcher.in_scope.contains(each.object.value)) continue;
        for (const auto& [attribute, value] : each.newest)
          if (watcher.subscribed.contains({attribute})) {
            ASSERT_EQ(watcher.values.at(each.object.value).at(attribute), value)
                << "tick " << ticks_ << ", watcher " << k << ", object " << each.object.value
                << ", attribute " << attribute;
          }
      }
    }
  }
  /// Nobody moves any more, until everything that was lost has come again.
  void settle() {
    for (std::size_t k = 1; k < session_.watchers.size(); ++k)
      session_.watchers[k].is_reading = true;
    session_.is_over = true;
    for (int i = 0; i < 600; ++i) {  // of four datagrams one is lost again
      ask(1);
      session_.tick();
    }
    session_.is_over = false;
    is_settled_ = true;
  }
  const rti::FederationCounters& counters() const { return session_.execution.counters(); }

 private:
  struct Owned {
    rti::ObjectHandle object;
    rti::RegionHandle region;
    Shape shape;
    Input input;
    Trajectory trajectory;
    std::map<std::uint32_t, Values> newest;
  };
  unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }
  double grid(double step, double size) {
    const double value = std::uniform_real_distribution<double>(-size, size)(random_);
    return std::nearbyint(value / step) * step + 0.0;  // as policies round, without a negative zero
  }
  static rti::AttributeSet every() {
    return {rink_model().shape, rink_model().input, rink_model().trajectory, rink_model().position};
  }
  rti::Ambassador& owner() { return session_.watchers.front().ambassador; }

  void look(Watcher& watcher) {
    const double x = below(8), y = below(4);
    watcher.ambassador.set_region(watcher.region, {x, y, x + 4.0, y + 3.0});
  }
  void subscribe(Watcher& watcher, rti::AttributeSet set) {
    watcher.ambassador.subscribe_object_class_attributes(rink_model().entity, set, watcher.region);
    watcher.subscribed = set;
  }
  /// Values in receive order reach it only while it waits for a grant.
  void constrain(Watcher& watcher) {
    watcher.ambassador.enable_time_constrained();
    for (int i = 0; i < 3; ++i) session_.tick();
    constrained_ = &watcher;
  }
  /// Who is constrained asks to advance, once in `rarely` times.
  void ask(unsigned rarely) {
    if (constrained_ == nullptr || constrained_->is_waiting || below(rarely) != 0) return;
    constrained_->is_waiting = true;
    constrained_->ambassador.time_advance_request(rti::LogicalTime{asked_ += 1.0});
  }
  /// One watcher always subscribes to all, for what nobody hears the owner keeps back.
  void change(Watcher& watcher, bool may_subscribe) {
    if (below(4) == 0) {
      look(watcher);
      watcher.ambassador.commit_region_modifications(watcher.region);
    }
    const rti::AttributeSet sets[] = {
        every(),
        {rink_model().trajectory, rink_model().position},
        {rink_model().shape, rink_model().input, rink_model().trajectory}};
    if (may_subscribe && below(16) == 0) subscribe(watcher, sets[below(3)]);
    watcher.is_reading = below(6) != 0;
    if (may_subscribe && &watcher != constrained_ && below(16) == 0)
      watcher.forget(objects_[below(static_cast<unsigned>(objects_.size()))].object);
  }

  void add() {
    Owned& added = objects_.emplace_back();
    const std::string name = below(2) == 0 ? "" : "entity " + std::to_string(++named_);
    added.object = owner().register_object_instance(rink_model().entity, name);
    added.region = owner().create_region();
    const double x = below(11), y = below(6);
    owner().set_region(added.region, {x, y, x + 0.5, y + 0.5});
    owner().commit_region_modifications(added.region);
    owner().associate_regions_for_updates(added.object, added.region);
    added.shape = {.kind = 1,
                   .drag = below(2) == 0 ? 0.25f : 3.0f,
                   .friction = below(3) == 0 ? 0.4f : 0.0f,
                   .thrust = 4.9f,
                   .mass = below(4) == 0   ? 0.0f
                           : below(2) == 0 ? 0.5f
                                           : 1.25f};
    move(added);
    send(added, {rink_model().shape, rink_model().input, rink_model().trajectory}, below(2));
  }
  void replace(std::size_t which) {
    owner().delete_object_instance(objects_[which].object);
    owner().delete_region(objects_[which].region);
    objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(which));
    add();
  }
  void move(Owned& each) {
    each.input.count += 1 + below(2);
    each.input.held = static_cast<std::uint8_t>(below(16));
    each.trajectory = {.time = std::floor(now_ * 1024.0 - below(16)) / 1024.0,
                       .position = {grid(trajectory_position_step, 20.0) + 20.0,
                                    grid(trajectory_position_step, 20.0) + 20.0},
                       .velocity = {grid(trajectory_velocity_step, 2.0), 0.5}};
    const auto thrust = static_cast<double>(4.9f);
    if (below(3) == 0) each.trajectory.acceleration = {thrust, 0.0};
    if (below(9) == 0) each.trajectory.acceleration = {1.5, 0.25};  // of a group: it travels whole
    if (below(9) == 0) each.trajectory = {.position = each.trajectory.position};
  }
  /// The trajectory that was sent last.
  static Trajectory sent(const Owned& each) {
    Trajectory t;
    EXPECT_TRUE(decode(each.newest.at(rink_model().trajectory.value), t));
    return t;
  }
  /// Two bodies hit each other: what one gains in momentum the other loses, but for rounding.
  void hit() {
    Owned &one = objects_[below(static_cast<unsigned>(objects_.size()))],
          &other = objects_[below(static_cast<unsigned>(objects_.size()))];
    if (&one == &other || one.shape.mass == 0.0f || other.shape.mass == 0.0f) return;
    const Trajectory former = sent(other), before = sent(one);
    const double instant = std::floor(now_ * 1024.0 - below(16)) / 1024.0;
    const double ratio =
        static_cast<double>(one.shape.mass) / static_cast<double>(other.shape.mass);
    const Lead led = lead_of(before, one.shape, instant),
               lead = lead_of(former, other.shape, instant);
    const auto rounded = [](double step, const Vector2& value) {
      return Vector2(std::nearbyint(value.x() / step) * step + 0.0,
                     std::nearbyint(value.y() / step) * step + 0.0);
    };
    const auto moved = [&](const Lead& from, const Vector2& gain) {
      return Trajectory{.time = instant,
                        .position = rounded(trajectory_position_step, from.position),
                        .velocity = rounded(trajectory_velocity_step, from.velocity + gain)};
    };
    one.trajectory = moved(led, {grid(trajectory_velocity_step, 2.0), 0.5});
    other.trajectory = moved(lead, ratio * (led.velocity - one.trajectory.velocity));
    send(one, {rink_model().trajectory}, 0);
    send(other,
         below(3) == 0 ? rti::AttributeSet{rink_model().input, rink_model().trajectory}
                       : rti::AttributeSet{rink_model().trajectory},
         0);
  }
  void update(std::size_t which) {
    Owned& each = objects_[which];
    move(each);
    const rti::AttributeSet sets[] = {{rink_model().trajectory},
                                      {rink_model().trajectory},
                                      {rink_model().input},
                                      {rink_model().input, rink_model().trajectory},
                                      {rink_model().position},
                                      {rink_model().shape, rink_model().trajectory},
                                      {rink_model().trajectory, rink_model().position}};
    const unsigned kind = below(14);
    if (kind == 5) each.shape.drag = static_cast<float>(below(4));
    send(each, sets[kind < 7 ? kind : kind % 2], below(2));
  }
  void send(Owned& each, rti::AttributeSet set, std::uint64_t tag) {
    Values values;
    rti::Writer writer(values);
    set.for_each([&](rti::AttributeHandle attribute) {
      const std::size_t before = values.size();
      Position position{static_cast<float>(now_), 1.0f};
      if (attribute == rink_model().shape) exchange(writer, each.shape);
      else if (attribute == rink_model().input) exchange(writer, each.input);
      else if (attribute == rink_model().position) exchange(writer, position);
      else exchange(writer, each.trajectory);
      each.newest[attribute.value] =
          Values(values.begin() + static_cast<std::ptrdiff_t>(before), values.end());
    });
    owner().update_attribute_values(each.object, set, values, rti::Stamp{now_, tag});
  }

  std::mt19937_64 random_;
  Session session_;
  std::vector<Owned> objects_;
  Watcher* constrained_ = nullptr;
  bool is_settled_ = false;
  double asked_ = 100.0;
  unsigned named_ = 0;
  bool is_quiet_;  ///< few updates, so that some objects come back unchanged
  double now_ = 10.0;
  int ticks_ = 0;
};

TEST(ResidualSession, FederatesHaveTheOwnersValuesWhateverEntersLeavesOrIsHeldBack) {
  std::uint64_t residuals = 0, companions = 0, held_back = 0, held = 0;
  for (unsigned seed = 0; seed < 60 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(seed, seed % 3 == 0 ? "none" : "region");
    for (int tick = 0; tick < 100 && !testing::Test::HasFatalFailure(); ++tick) {
      play.tick();
      play.compare();
    }
    play.settle();
    play.compare();
    residuals += play.counters().residuals_sent;
    companions += play.counters().companions_sent;
    held_back += play.counters().updates_held_back;
    held += play.counters().entries_held;
  }
  EXPECT_GT(residuals, 5000u) << "or the test shows nothing";
  EXPECT_GT(companions, 500u);
  EXPECT_GT(held_back, 1000u);
  EXPECT_GT(held, 100u);
}

TEST(ResidualSession, ByTurnsFederatesHaveTheOwnersValuesOnceAllHadTheirTurn) {
  std::uint64_t put_off = 0, entries = 0;
  for (unsigned seed = 0; seed < 40 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(seed, seed % 2 == 0 ? "region with tiers(at=0.2 at=0.5)"
                                  : "region with priority(budget=120)");
    for (int round = 0; round < 6 && !testing::Test::HasFatalFailure(); ++round) {
      for (int tick = 0; tick < 20; ++tick) play.tick();
      play.settle();
      play.compare();
    }
    put_off += play.counters().updates_put_off;
    entries += play.counters().scope_entries;
  }
  EXPECT_GT(put_off, 5000u) << "or the test shows nothing";
  EXPECT_GT(entries, 3000u);
}

TEST(ResidualSession, OverAStormFederatesHaveTheOwnersValuesOnceItIsOver) {
  std::uint64_t residuals = 0, companions = 0, repaired = 0;
  for (unsigned seed = 0; seed < 24 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(seed, seed % 3 == 0 ? "none" : "region", 1000 + seed);
    for (int round = 0; round < 4 && !testing::Test::HasFatalFailure(); ++round) {
      for (int tick = 0; tick < 60; ++tick) play.tick();
      play.settle();
      play.compare();
    }
    residuals += play.counters().residuals_sent;
    companions += play.counters().companions_sent;
    repaired += play.counters().updates_repaired;
  }
  EXPECT_GT(residuals, 3000u) << "or the test shows nothing";
  EXPECT_GT(companions, 300u);
  EXPECT_GT(repaired, 100u);
}

}  // namespace
}  // namespace rink::game::residuals
