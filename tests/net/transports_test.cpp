// One game in the synchronous pace, its keys pressed by its players, over every transport: the same
// states at the server and in every player's eyes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>

#include "game/net/client/client.h"
#include "game/net/server/serving.h"
#include "game/replication/trajectory_codec.h"
#include "rti/transport/in_process.h"
#include "rti/transport/modelled/virtual_network.h"
#include "rti/transport/socket_transport.h"
#include "tests/net/scenes.h"
#include "tests/net/wall_clock.h"
#include "tests/places.h"

namespace rink::game {
namespace {

/// The server's and the players' end of one kind of transport.
struct Carrier {
  std::function<rti::Transport&()> server, players;
  std::function<rti::ConnectionId()> connect;
  std::function<void()> pass_time = [] {};
  std::shared_ptr<void> owner;
};

template <class Network, class Endpoint>
struct Local {
  template <class... Arguments>
  explicit Local(Arguments&... arguments) : network(arguments...) {
    server.listen("here");
  }
  Network network;
  Endpoint server{network}, players{network};
};

Carrier in_process() {
  auto local = std::make_shared<Local<rti::InProcessNetwork, rti::InProcessEndpoint>>();
  return {.server = [local]() -> rti::Transport& { return local->server; },
          .players = [local]() -> rti::Transport& { return local->players; },
          .connect = [local] { return local->players.connect("here"); },
          .owner = local};
}

Carrier virtual_network() {
  static rti::ConstantDelay delay(500'000);
  auto local = std::make_shared<Local<rti::VirtualNetwork, rti::VirtualEndpoint>>(delay);
  local->network.carry_datagrams();
  return {.server = [local]() -> rti::Transport& { return local->server; },
          .players = [local]() -> rti::Transport& { return local->players; },
          .connect = [local] { return local->players.connect("here"); },
          .pass_time = [local] { local->network.advance_to(local->network.now_ns() + 250'000); },
          .owner = local};
}

Carrier sockets(const std::string& name) {
  struct Ends {
    explicit Ends(const std::string& name)
        : server(name), players(name), port(server.listen("127.0.0.1", 0)) {}
    rti::SocketTransport server, players;
    std::uint16_t port;
  };
  auto ends = std::make_shared<Ends>(name);
  return {.server = [ends]() -> rti::Transport& { return ends->server.get(); },
          .players = [ends]() -> rti::Transport& { return ends->players.get(); },
          .connect = [ends] { return ends->players.connect("127.0.0.1", ends->port); },
          .owner = ends};
}

/// What a run ended in.
struct Outcome {
  std::uint64_t state_hash = 0;
  std::vector<std::map<std::uint32_t, std::pair<float, float>>>
      seen;  ///< by player: positions of what is in scope
  std::uint64_t datagrams = 0;
  std::uint64_t replayed_hash = 0;  ///< of the game played alone with the recorded keys
  std::uint64_t grants = 0, timed_sent = 0;
  std::uint64_t cut_short = 0;   ///< ticks
  std::uint64_t told_wrong = 0;  ///< how often a player had another time than the game
};

/// Four players, 60 ticks, keys by a seed.
class SynchronousGame {
 public:
  SynchronousGame(const Carrier& carrier, const std::string& policy, bool is_time_managed = false,
                  std::uint64_t events_per_s = 0)
      : carrier_(carrier),
        scene_(small_crowd()),
        fom_(load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml")),
        model_(fom_),
        serving_(fom_, scene_,
                 {.policy = policy,
                  .is_synchronous = true,
                  .is_time_managed = is_time_managed,
                  .replay = {},
                  .events_per_s = events_per_s},
                 federation_settings(scene_, "region", 0.0),
                 {now_s, [this] { return serving_.server().game().now(); }}) {
    serving_.host().add(carrier.server());
    for (int i = 0; i < player_count; ++i) {
      ClientSettings settings;
      settings.name = "bat-" + std::to_string(i);
      settings.view_fraction = 0.3;
      Player& player = players_.emplace_back();
      player.client = std::make_unique<Client>(fom_, model_, settings);
      player.link = std::make_unique<rti::FederateLink>(player.client->ambassador(),
                                                        carrier.players(), carrier.connect());
      links_.add(*player.link);
    }
  }

  Outcome play() {
    TickCosts costs;
    until([&] { return serving_.server().seats().player_count() == player_count; },
          [&] {
            if (serving_.server().is_joined()) serving_.send(0.0, 0.0, costs);
          });
    serving_.server().call_to_start();
    until([&] { return serving_.server().is_started() && all_play(); },
          [&] { serving_.send(0.0, 0.0, costs); });
    // Datagrams need their way first, or there would be none to compare.
    const double patience_s = now_s() + 0.3;
    until([&] { return now_s() > patience_s; }, [] {});
    std::mt19937 random(11);
    for (int tick = 1; tick <= 60; ++tick) {
      for (Player& player : players_) {
        const Key key = all_keys[random() % all_keys.size()];
        random() % 2 == 0 ? player.client->press(key) : player.client->release(key);
        player.client->end_turn();
      }
      until([&] { return serving_.server().may_step(); }, [] {});
      serving_.tick(tick / 30.0, 0.0);
      while (serving_.server().game().is_cut_short()) go_on_with(tick);
      // Everybody's view follows before the next turn, so that it is the same however long news
      // takes.
      settle();
      for (Player& player : players_) player.client->follow_bat();
      settle();
      serving_.send(tick / 30.0, 0.0, costs);
      settle();
    }
    return outcome();
  }

 private:
  static constexpr int player_count = 4;
  struct Player {
    std::unique_ptr<Client> client;
    std::unique_ptr<rti::FederateLink> link;
  };
  bool all_play() const {
    return std::ranges::all_of(players_, [](const Player& each) {
      return each.client->state() == Client::State::playing;
    });
  }
  /// A player takes turns at instants that the game has reached, and none within a tick of logical
  /// time.
  void go_on_with(int tick) {
    settle();
    const double now = serving_.server().game().now();
    for (Player& player : players_) {
      const TurnTaker& turns = player.client->turns();
      const bool has_whole_ticks = turns.is_time_managed();
      if (turns.has_turn() == has_whole_ticks ||
          turns.turn_s() != (has_whole_ticks ? (tick - 1) / 30.0 : now))
        ++told_wrong_;
      if (turns.has_turn()) player.client->end_turn();
    }
    until([&] { return serving_.server().may_step(); }, [] {});
    serving_.tick(tick / 30.0, 0.0);
  }
  void round() {
    carrier_.pass_time();
    links_.flush(now_s());
    serving_.exchange(0.0);
    carrier_.pass_time();
    carrier_.players().poll({}, links_);
  }
  template <class Condition, class Step>
  void until(Condition is_met, Step step) {
    for (const double give_up_s = now_s() + 20.0; !is_met() && now_s() < give_up_s;) {
      round();
      step();
    }
    ASSERT_TRUE(is_met());
  }
  /// Until nothing has been heard for a while.
  void settle() {
    std::uint64_t heard = 0;
    for (int quiet = 0; quiet < 12; ++quiet) {
      round();
      std::uint64_t now_heard = serving_.execution().counters().bytes_received;
      for (const Player& each : players_)
        now_heard += each.client->ambassador().counters().bytes_received;
      if (now_heard != heard) quiet = 0;
      heard = now_heard;
    }
  }
  Outcome outcome() const {
    Outcome outcome;
    outcome.state_hash = serving_.server().game().hash();
    Game alone(scene_);
    for (const InputEvent& event : serving_.server().keys().recorded()) alone.submit(event);
    alone.advance(serving_.server().game().now());
    outcome.replayed_hash = alone.hash();
    outcome.grants = serving_.execution().counters().time_advance_grants;
    outcome.timed_sent = serving_.execution().counters().timed_sent;
    outcome.cut_short = serving_.server().budget().counters().ticks_cut_short;
    outcome.told_wrong = told_wrong_;
    outcome.datagrams = serving_.execution().counters().datagrams_sent;
    for (const Player& each : players_) {
      auto& seen = outcome.seen.emplace_back();
      for (const EntityReplica& entity : each.client->replicas().entities())
        if (entity.in_scope)
          seen[entity.object.value] = {static_cast<float>(entity.position_at(2.0).x()),
                                       static_cast<float>(entity.position_at(2.0).y())};
    }
    return outcome;
  }

  const Carrier& carrier_;
  const Scene scene_;
  const rti::Fom fom_;
  const ObjectModel model_;
  Serving serving_;
  rti::FederateLinks links_;
  std::deque<Player> players_;
  std::uint64_t told_wrong_ = 0;
};

class EveryTransportsGame : public testing::TestWithParam<const char*> {};

TEST_P(EveryTransportsGame, EndsInTheSameStateAndLooksTheSameToEveryPlayer) {
  const auto play = [](const Carrier& carrier) {
    return SynchronousGame(carrier, GetParam()).play();
  };
  const Outcome expected = play(in_process());
  ASSERT_EQ(expected.seen.size(), 4u);
  for (const auto& seen : expected.seen) EXPECT_GT(seen.size(), 5u);
  EXPECT_EQ(expected.datagrams, 0u);
  const std::vector<std::pair<std::string, Carrier>> others{{"tcp", sockets("tcp")},
                                                            {"udp", sockets("udp")},
                                                            {"shared memory", sockets("shm")},
                                                            {"bundle", sockets("bundle")},
                                                            {"virtual network", virtual_network()}};
  for (const auto& [name, carrier] : others) {
    SCOPED_TRACE(name);
    const Outcome is = play(carrier);
    EXPECT_EQ(is.state_hash, expected.state_hash);
    EXPECT_EQ(is.seen, expected.seen);
    const bool takes_datagrams =
        std::string(GetParam()) == "periodic" && (name == "udp" || name == "virtual network");
    EXPECT_EQ(is.datagrams > 0, takes_datagrams);
  }
}

TEST_P(EveryTransportsGame, IsTheSameToTheBitUnderTimeManagement) {
  const Outcome expected = SynchronousGame(in_process(), GetParam()).play();
  EXPECT_EQ(expected.replayed_hash, expected.state_hash);
  for (const auto& [name, carrier] : {std::pair{"in process", in_process()},
                                      {"tcp", sockets("tcp")},
                                      {"shared memory", sockets("shm")}}) {
    SCOPED_TRACE(name);
    const Outcome is = SynchronousGame(carrier, GetParam(), true).play();
    EXPECT_EQ(is.state_hash, expected.state_hash);
    EXPECT_EQ(is.replayed_hash, expected.state_hash);
    EXPECT_EQ(is.seen, expected.seen);
    EXPECT_GE(is.grants, 60u * 5u);      // to four players and the server, for each tick
    EXPECT_GT(is.timed_sent, 60u * 4u);  // turns and keys at least
  }
}

TEST_P(EveryTransportsGame, IsTheSameToTheBitWithTicksCutShortByABudget) {
  const Outcome expected = SynchronousGame(in_process(), GetParam()).play();
  EXPECT_EQ(expected.cut_short, 0u);
  for (const bool is_time_managed : {false, true}) {
    SCOPED_TRACE(is_time_managed ? "time management" : "turns");
    const Outcome is = SynchronousGame(in_process(), GetParam(), is_time_managed, 20).play();
    EXPECT_GT(is.cut_short, 20u);
    EXPECT_EQ(is.told_wrong, 0u);
    EXPECT_EQ(is.state_hash, expected.state_hash);
    EXPECT_EQ(is.replayed_hash, expected.state_hash);
    if (is_time_managed) {
      EXPECT_EQ(is.seen, expected.seen);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Policies, EveryTransportsGame, testing::Values("periodic", "on-event"),
                         [](const auto& info) {
                           return std::string(info.param == std::string("periodic") ? "periodic"
                                                                                    : "on_event");
                         });

}  // namespace
}  // namespace rink::game
