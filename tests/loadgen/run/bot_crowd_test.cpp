// What a crowd measures while its own clock stands still for a moment: a stall of the bots shows in
// every latency that it lengthened.
#include "loadgen/run/bots/bot_crowd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/model/scene_file.h"
#include "game/net/fom_file.h"
#include "game/net/server/serving.h"
#include "game/net/server_trace.h"
#include "game/replication/trajectory_codec.h"
#include "loadgen/run/bots/bots_report.h"
#include "loadgen/run/virtual_parts.h"
#include "rti/transport/modelled/virtual_network.h"

namespace rink::loadgen {
namespace {

/// Hands on what one poll brings as a kernel does: all bytes of a connection that came since the
/// last poll at once.
class OneRead final : public rti::Transport, private rti::TransportListener {
 public:
  explicit OneRead(rti::Transport& inner) : inner_(inner) {}
  void poll(std::chrono::nanoseconds longest_wait, rti::TransportListener& listener) override {
    listener_ = &listener;
    inner_.poll(longest_wait, *this);
    for (auto& [connection, bytes] : std::exchange(waiting_, {})) {
      const std::size_t now = bytes.size() - std::min(held_back, bytes.size());
      if (now > 0) listener.on_bytes(connection, std::span(bytes).first(now));
      if (now < bytes.size())
        waiting_[connection].assign(bytes.begin() + static_cast<std::ptrdiff_t>(now), bytes.end());
    }
  }
  std::size_t held_back =
      0;  ///< bytes at the end of each connection's that only the next poll brings
  void send(rti::ConnectionId connection, std::span<const rti::Bytes> parts) override {
    inner_.send(connection, parts);
  }
  void close(rti::ConnectionId connection) override { inner_.close(connection); }
  rti::TransportCounters counters(rti::ConnectionId connection) const override {
    return inner_.counters(connection);
  }

 private:
  void on_open(rti::ConnectionId connection) override { listener_->on_open(connection); }
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override {
    waiting_[connection].insert(waiting_[connection].end(), bytes.begin(), bytes.end());
  }
  void on_close(rti::ConnectionId connection, rti::CloseReason reason,
                const std::string& detail) override {
    listener_->on_close(connection, reason, detail);
  }

  rti::Transport& inner_;
  rti::TransportListener* listener_ = nullptr;
  std::map<rti::ConnectionId, std::vector<std::byte>> waiting_;
};

/// A server that ticks 50 times a second, and both players of a match, who hear it without delay
/// whenever their process runs.
class StalledCrowd : public testing::Test {
 protected:
  static constexpr double rate_hz = 50.0;
  static constexpr std::uint32_t bots = 2;

  /// `plan`: keys to press; those due before `warm_up_s` of simulated time are not counted.
  void start(const std::vector<game::InputEvent>& plan, double warm_up_s, double duration_s) {
    crowd_.emplace(
        fom_, reads_,
        BotCrowdSettings{
            .count = bots, .view_fraction = 1.0, .warm_up_s = warm_up_s, .duration_s = duration_s},
        plan, [this] { return network_.now_s(); });
    crowd_->connect([this](std::uint32_t) { return bots_end_.connect("server"); });
    game::TickCosts uncounted;
    const auto step = [&] {
      network_.advance_to(network_.now_ns() + 20'000'000);
      serving_.exchange(0.0);
      if (serving_.server().is_joined()) serving_.send(0.0, 0.0, uncounted);
      crowd_->run_once();
    };
    while (serving_.server().seats().player_count() < bots) step();
    serving_.server().call_to_start();
    while (!serving_.server().is_started()) step();
    start_ns_ = (network_.now_ns() / second_ns + 1) * second_ns;
    network_.advance_to(start_ns_);
  }
  /// Plays ticks up to that of simulated `until_s`, which comes last; the bots run after each if
  /// they are not `stalled`.
  void play(double until_s, bool is_stalled = false) {
    for (; next_tick_ <= std::llround(until_s * rate_hz); ++next_tick_) {
      run_until(static_cast<double>(next_tick_) / rate_hz, is_stalled);
      serving_.tick(static_cast<double>(next_tick_) / rate_hz, network_.now_s());
      network_.advance_to(network_.now_ns());
      if (!is_stalled) crowd_->run_once();
    }
  }
  /// Nothing is played until `until_s`; then come the ticks that were due since, late, and what
  /// they sent is read.
  void play_late(double until_s) {
    network_.advance_to(start_ns_ + nanoseconds(until_s));
    for (; next_tick_ <= std::llround(until_s * rate_hz); ++next_tick_) {
      const double due_s = static_cast<double>(next_tick_) / rate_hz;
      serving_.tick(due_s, 1e-9 * static_cast<double>(start_ns_) + due_s);
    }
    network_.advance_to(network_.now_ns());
    crowd_->run_once();
  }
  /// The instant [s] comes, and what was sent by then reaches who runs.
  void run_until(double instant_s, bool is_stalled = false) {
    network_.advance_to(start_ns_ + nanoseconds(instant_s));
    if (!is_stalled) crowd_->run_once();
    network_.advance_to(network_.now_ns());
    serving_.exchange(0.0);
  }
  /// What the server noted of a game of 2 s, of each kind at most `record_max`.
  game::ServerTrace noted(std::size_t record_max) {
    start({}, 0.0, 2.0);
    serving_.collect_trace(
        {.seed = 1, .clients = bots, .from_s = 0.0, .until_s = 2.0, .record_max = record_max},
        rate_hz);
    play(2.0);
    return serving_.trace().value();
  }
  const Measurements& measured() const { return crowd_->meter().measurements(); }
  static game::InputEvent key(double instant_s) {
    return {
        .time = instant_s, .player = 0, .kind = game::InputKind::key_down, .key = game::Key::right};
  }

  rti::ConstantDelay model_{0};
  rti::VirtualNetwork network_{model_};
  rti::VirtualEndpoint server_end_{network_}, bots_end_{network_};
  OneRead reads_{bots_end_};
  const rti::Fom fom_ = game::load_rink_fom(game::fom_file());
  const game::Scene scene_ = game::load_scene("match");
  std::int64_t start_ns_ = 0;
  long next_tick_ = 0;
  game::Serving serving_{
      fom_,
      scene_,
      [] {
        game::ServerSettings settings;
        settings.tick_s = 1.0 / rate_hz;
        return settings;
      }(),
      game::federation_settings(scene_, "none", 0.0),
      {[this] { return network_.now_s(); },
       [this] { return 1e-9 * static_cast<double>(network_.now_ns() - start_ns_); }}};
  std::optional<BotCrowd> crowd_;

  void SetUp() override {
    server_end_.listen("server");
    serving_.host().add(server_end_);
  }
};

/// Three ticks wait in the sockets while nobody reads, and are read at once 60 ms after the first
/// of them was due.
TEST_F(StalledCrowd, EachTickOfOneReadIsASampleAsOldAsItsOwnTick) {
  start({}, 0.0, 2.0);
  play(0.38);
  EXPECT_EQ(measured().update_latency.count(), 20u * bots) << "ticks 0 to 19";
  play(0.44, true);
  run_until(0.46);
  EXPECT_EQ(measured().update_latency.count(), 23u * bots);
  EXPECT_NEAR(measured().update_latency.max_s(), 0.06, 1e-9);
  EXPECT_NEAR(*measured().update_latency.mean_s() * 23 * bots, (0.06 + 0.04 + 0.02) * bots, 1e-9)
      << "and none of the others waited";
  play(1.98);
  EXPECT_EQ(measured().update_latency.count(), 100u * bots) << "clients x ticks";
}

/// What StallLong expects of sockets, to the last tick: of n that are due while one of both is not
/// run for n - 1 periods, each is as old as it waited, whoever was stopped.
TEST_F(StalledCrowd, IsInTheAgesAsMuchAsAStalledServerFor60And500Milliseconds) {
  start({}, 0.0, 4.0);
  double at_s = 0.38, expected_s = 0.0, longest_s = 0.0;
  play(at_s);
  for (const double stall_s : {0.06, 0.5})
    for (const bool is_of_bots : {true, false}) {
      SCOPED_TRACE(stall_s);
      const double begin_s = at_s + 1.0 / rate_hz, end_s = begin_s + stall_s;
      if (is_of_bots) {
        play(end_s - 1.0 / rate_hz, true);
        play(end_s);
      } else {
        play_late(end_s);
      }
      const double waits = std::round(stall_s * rate_hz);  // of 0, 1, ... periods
      expected_s += waits * (waits + 1.0) / 2.0 / rate_hz * bots;
      longest_s = std::max(longest_s, stall_s);
      EXPECT_EQ(measured().update_latency.count(), static_cast<std::uint64_t>(next_tick_) * bots)
          << "clients x ticks";
      EXPECT_NEAR(*measured().update_latency.mean_s() *
                      static_cast<double>(measured().update_latency.count()),
                  expected_s, 1e-9);
      EXPECT_NEAR(measured().update_latency.max_s(), longest_s, 1e-9);
      at_s = end_s + 0.1;
      play(at_s);
    }
}

/// The last byte of tick 20 comes 12 ms after the others, and until then nothing of it can be
/// applied.
TEST_F(StalledCrowd, ATickThatIsReadInPiecesCountsOnceWhenItIsWhole) {
  start({}, 0.0, 2.0);
  play(0.38);
  reads_.held_back = 1;
  play(0.4);
  EXPECT_EQ(measured().update_latency.count(), 20u * bots);
  reads_.held_back = 0;
  run_until(0.412);
  EXPECT_EQ(measured().update_latency.count(), 21u * bots);
  EXPECT_NEAR(measured().update_latency.max_s(), 0.012, 1e-9);
}

/// The process is not run for 200 ms; the key that was due at the beginning of that goes out late,
/// and whoever counts from then hides the stall.
TEST_F(StalledCrowd, AKeysLatencyCountsFromWhenItWasDueAndNotFromWhenItWasSent) {
  start({key(1.0)}, 0.5, 2.0);
  play(0.98);
  play(1.18, true);
  run_until(1.2 - 1e-3);
  EXPECT_EQ(measured().keys_sent, 1u);
  EXPECT_NEAR(measured().send_lateness.max_s(), 0.199, 1e-9);
  EXPECT_EQ(measured().late_sends, 1u);
  play(1.3);
  ASSERT_EQ(measured().input_latency.count(), 1u);
  EXPECT_NEAR(measured().input_latency.max_s(), 0.2, 1e-9)
      << "due at 1 s, felt by the tick at 1.2 s";
  EXPECT_NEAR(measured().input_latency.min_s(), 0.2, 1e-9);
  EXPECT_EQ(crowd_->bots().unanswered_keys(), 0u);
}

TEST_F(StalledCrowd, AKeyIsLateFromTenMillisecondsOn) {
  start({key(0.605), key(0.805)}, 0.5, 2.0);
  play(0.6);
  run_until(0.605 + Probe::late_s - 1e-4);
  EXPECT_EQ(measured().keys_sent, 1u);
  EXPECT_EQ(measured().late_sends, 0u);
  play(0.8);
  run_until(0.805 + Probe::late_s + 1e-4);
  EXPECT_EQ(measured().late_sends, 1u);
  EXPECT_EQ(measured().keys_sent, 2u);
  EXPECT_EQ(bots_report(*crowd_, "")["late_sends_fraction"], 0.5);
}

/// Late in fifty: one by chance in 39 of 100 runs whose keys are late with a probability of 1 %,
/// four in 1.6 of 1,000.
TEST(Schedule, IsNotKeptOnceSoManyLateKeysCannotBeChance) {
  const auto problem = [](std::uint64_t late, std::uint64_t sent) {
    Measurements measured;
    measured.late_sends = late, measured.keys_sent = sent;
    return measured.schedule_trouble();
  };
  EXPECT_EQ(problem(0, 0), "");
  EXPECT_EQ(problem(1, 50), "");
  EXPECT_EQ(problem(3, 50), "");
  EXPECT_EQ(problem(4, 50), "4 of 50 keys went out more than 10 ms late");
  EXPECT_EQ(problem(18, 1'000), "");
  EXPECT_EQ(problem(19, 1'000), "19 of 1000 keys went out more than 10 ms late");
  EXPECT_EQ(problem(1'050, 100'000), "") << "1.6 standard deviations";
  EXPECT_NE(problem(1'100, 100'000), "") << "3.2";
}

/// Warm-up is from 0 to 0.5 s, the end at 1 s: ticks 25 to 49 and what happens between 0.5 s,
/// itself included, and 1 s.
TEST_F(StalledCrowd, WhatHappensBeforeTheSpanOrAtItsEndIsNotCounted) {
  start({key(0.1), key(0.5), key(0.7)}, 0.5, 1.0);
  play(0.48);
  EXPECT_EQ(measured().update_latency.count(), 0u);
  EXPECT_EQ(measured().keys_due, 0u);
  const CrowdTraffic before = crowd_->bots().traffic();
  play(1.2);
  EXPECT_EQ(measured().update_latency.count(), 25u * bots);
  EXPECT_EQ(measured().keys_due, 2u);
  EXPECT_EQ(measured().keys_sent, 2u);
  EXPECT_EQ(measured().input_latency.count(), 2u);
  EXPECT_NEAR(crowd_->meter().measured_s(), 0.5, 1e-9);
  const CrowdTraffic whole = crowd_->bots().traffic(), within = crowd_->meter().traffic();
  EXPECT_EQ(within.updates_received * 36, (whole.updates_received - before.updates_received) * 25)
      << "of ticks 25 to 60 those before the 50th; each has as many";
  std::uint64_t by_bot = 0;
  for (const std::uint64_t bytes : crowd_->meter().received_by_bot()) by_bot += bytes;
  EXPECT_EQ(by_bot, within.bytes_received);
}

/// Of a span of 2 s at 50 Hz there are 100 ticks and, of both players, the decisions at 20
/// instants.
TEST_F(StalledCrowd, TheServerNotesAllOfItsRunWhereThereIsRoom) {
  const game::ServerTrace trace = noted(1'000'000);
  EXPECT_EQ(trace.ticks.size(), 100u);
  EXPECT_EQ(trace.decisions.size(), 20u * bots);
  EXPECT_GE(trace.in_scope.size(), 3u * trace.decisions.size()) << "the puck and both bats";
}

TEST_F(StalledCrowd, TheServerNotesNoMoreTicksAndDecisionsThanThereIsRoomFor) {
  constexpr std::size_t record_max = 30;
  const game::ServerTrace trace = noted(record_max);
  EXPECT_EQ(trace.ticks.size(), record_max);
  EXPECT_LE(trace.in_scope.size(), 2 * record_max) << "objects of all decisions together";
  std::map<std::uint32_t, int> by_player;
  for (const game::ServerTrace::Decision& decision : trace.decisions) ++by_player[decision.player];
  EXPECT_EQ(by_player.size(), bots) << "one player at a time, in turn";
}

}  // namespace
}  // namespace rink::loadgen
