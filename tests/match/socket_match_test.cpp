// A whole match over TCP: the same server and clients as between machines, on a clock that does not
// wait.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <memory>
#include <sstream>
#include <string_view>

#include "game/control/key_log_file.h"
#include "game/control/key_log_packed.h"
#include "game/control/replay.h"
#include "game/net/client/network_match.h"
#include "game/net/server/serving.h"
#include "loadgen/duel/match_bot.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

/// A host on a port of this machine and its two players, each with a transport of its own. Bytes go
/// through the kernel; time is counted in ticks.
class SocketDuel {
 public:
  struct Client {
    Client(const ObjectModel& model, std::uint16_t port, const std::string& kind,
           std::uint64_t seed)
        : match(rink_fom(), model, transport, transport.connect("127.0.0.1", port),
                {.name = kind + std::to_string(seed)}),
          bot(kind, seed) {}
    rti::TcpTransport transport;
    NetworkMatch match;
    loadgen::MatchBot bot;
  };

  explicit SocketDuel(const FlowTimes& times = {})
      : serving_(rink_fom(), match_scene(),
                 {.policy = "on-event",
                  .tick_s = tick_s,
                  .replay = {},
                  .hosting = Hosting{times, match_text()}},
                 federation_settings(match_scene(), "none", 0.0),
                 {[this] { return now_s_; }, [this] { return now_s_; }}) {
    serving_.host().add(tcp_);
    port_ = tcp_.listen("127.0.0.1", 0);
    run_until([this] { return serving_.server().is_joined(); }, 1.0);
  }

  void connect(std::size_t k, const std::string& kind) {
    clients_[k] = std::make_unique<Client>(model_, port_, kind, k + 1);
  }
  NetworkMatch& client(std::size_t k) { return clients_[k]->match; }
  /// As if its process had died.
  void kill(std::size_t k) { clients_[k].reset(); }
  Server& server() { return serving_.server(); }
  std::uint16_t port() const { return port_; }

  template <class Condition>
  bool run_until(Condition condition, double seconds) {
    for (const double until_s = now_s_ + seconds; !condition();) {
      if (now_s_ >= until_s) return false;
      step();
    }
    return true;
  }
  bool is_shown_to_both(MatchPhase phase, double seconds) {
    return run_until(
        [&] { return client(0).sight().phase == phase && client(1).sight().phase == phase; },
        seconds);
  }

 private:
  static constexpr double tick_s = 1.0 / 60.0;

  void step() {
    now_s_ += tick_s;
    for (const auto& client : clients_) {
      if (!client) continue;
      client->bot.act(client->match, now_s_);
      client->match.advance(now_s_);
    }
    serving_.exchange(0.0);
    serving_.host().advance_clock(now_s_);
    if (serving_.server().is_joined())
      serving_.tick(serving_.server().follow_match(now_s_), now_s_);
  }

  double now_s_ = 100.0;
  const ObjectModel model_{rink_fom()};
  rti::TcpTransport tcp_;
  Serving serving_;
  std::uint16_t port_ = 0;
  std::array<std::unique_ptr<Client>, 2> clients_;
};

TEST(AMatchOverSockets, GoesFromFaceOffThroughGoalsToTheWinScreenAndToARematchByBoth) {
  SocketDuel duel;
  duel.connect(0, "chaser-expert"), duel.connect(1, "chaser-beginner");
  ASSERT_TRUE(duel.is_shown_to_both(MatchPhase::countdown, 2.0));
  EXPECT_EQ(duel.client(0).sight().own_team, Team::left);
  EXPECT_EQ(duel.client(1).sight().own_team, Team::right);
  ASSERT_TRUE(duel.is_shown_to_both(MatchPhase::playing, 4.0));
  std::uint32_t goals = 0;
  const auto is_over = [&] {
    const Score& score = duel.client(0).sight().score;
    EXPECT_LE(score.left + score.right, goals + 1) << "each goal is seen";
    goals = score.left + score.right;
    return duel.client(0).sight().phase == MatchPhase::over &&
           duel.client(1).sight().phase == MatchPhase::over;
  };
  ASSERT_TRUE(duel.run_until(is_over, 900.0)) << "first to five";
  for (std::size_t k = 0; k < 2; ++k) {
    const MatchSight& sight = duel.client(k).sight();
    EXPECT_EQ(sight.score, duel.server().game().score());
    EXPECT_EQ(std::max(sight.score.left, sight.score.right), 5u);
    EXPECT_EQ(sight.winner, sight.score.left == 5 ? Team::left : Team::right);
    EXPECT_EQ(sight.notice, "");
  }
  duel.client(1).rematch();
  ASSERT_TRUE(duel.run_until(
      [&] {
        return duel.client(0).sight().other_wants_rematch && duel.client(1).sight().wants_rematch;
      },
      1.0));
  EXPECT_EQ(duel.client(0).sight().phase, MatchPhase::over) << "one wish is not enough";
  duel.client(0).rematch();
  ASSERT_TRUE(duel.is_shown_to_both(MatchPhase::countdown, 1.0));
  ASSERT_TRUE(duel.is_shown_to_both(MatchPhase::playing, 4.0));
  EXPECT_EQ(duel.client(0).sight().score, Score{});
  EXPECT_EQ(duel.server().hosted()->state().number, 2u);
  duel.run_until([] { return false; }, 5.0);
  EXPECT_EQ(duel.client(0).sight().notice + duel.client(1).sight().notice, "");

  const std::vector<KeyLog> records = duel.server().hosted()->take_finished();
  ASSERT_EQ(records.size(), 1u);
  std::stringstream file;
  write_packed_key_log(file, records[0]);
  EXPECT_LE(static_cast<double>(file.str().size()),
            2500.0 + 4.0 * static_cast<double>(records[0].events.size()))
      << "a few kB";
  const KeyLog read = read_key_log(file, "match.keys");
  EXPECT_EQ(replay(read, recorded_scene(read, "match.keys")), *read.hash);
}

/// Opens and closes as it is told, and says what it is told to.
struct Stranger final : rti::TransportListener {
  void on_open(rti::ConnectionId) override { is_open = true; }
  void on_bytes(rti::ConnectionId, rti::Bytes) override {}
  void on_close(rti::ConnectionId, rti::CloseReason, const std::string&) override {
    is_dropped = true;
  }
  bool is_open = false, is_dropped = false;
};

TEST(AMatchOverSockets, GoesOnWhileAStrangerTalksNonsenseToItsHost) {
  SocketDuel duel;
  duel.connect(0, "waypoint"), duel.connect(1, "waypoint");
  ASSERT_TRUE(duel.is_shown_to_both(MatchPhase::playing, 6.0));
  rti::TcpTransport transport;
  for (const std::string_view nonsense :
       {std::string_view("GET / HTTP/1.1\r\n\r\n"), std::string_view("\xff\xff\xff\xff"),
        std::string_view("\x03\0\0\0\xc8\1\2", 7)}) {
    Stranger stranger;
    const rti::ConnectionId connection = transport.connect("127.0.0.1", duel.port());
    const auto is = [&](const bool& state) {
      return duel.run_until(
          [&] { return transport.poll(std::chrono::milliseconds(1), stranger), state; }, 5.0);
    };
    ASSERT_TRUE(is(stranger.is_open));
    const rti::Bytes bytes = std::as_bytes(std::span(nonsense));
    transport.send(connection, std::span(&bytes, 1));
    EXPECT_TRUE(is(stranger.is_dropped)) << nonsense;
  }
  const double time = duel.server().game().now();
  duel.run_until([] { return false; }, 1.0);
  EXPECT_NEAR(duel.server().game().now(), time + 1.0, 0.02);
  EXPECT_EQ(duel.client(0).sight().phase, MatchPhase::playing);
  EXPECT_EQ(duel.client(1).sight().phase, MatchPhase::playing);
}

TEST(AMatchOverSockets, WaitsForAPlayerWhoseProcessDied) {
  SocketDuel duel({.patience_s = 3.0});
  duel.connect(0, "waypoint"), duel.connect(1, "waypoint");
  ASSERT_TRUE(duel.is_shown_to_both(MatchPhase::playing, 6.0));
  duel.kill(1);
  ASSERT_TRUE(duel.run_until([&] { return duel.client(0).sight().phase == MatchPhase::away; }, 0.5))
      << "the kernel tells that the connection is gone";
  duel.connect(1, "waypoint");
  ASSERT_TRUE(duel.is_shown_to_both(MatchPhase::playing, 6.0));
  EXPECT_EQ(duel.server().hosted()->state().number, 1u);
  duel.kill(1);
  ASSERT_TRUE(
      duel.run_until([&] { return duel.client(0).sight().phase == MatchPhase::over; }, 4.0));
  EXPECT_EQ(duel.client(0).sight().winner, Team::left);
}

}  // namespace
}  // namespace rink::game
