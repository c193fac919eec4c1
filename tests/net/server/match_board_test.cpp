// What players hear of their hosted match, through an execution without transport: the state when
// it changes, the scene once, and the time when they ask.
#include "game/net/server/match_board.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "game/replication/attributes.h"
#include "rti/federation_execution.h"
#include "tests/net/rink_model.h"

namespace rink::game {
namespace {

/// Hears of matches, and answers to questions about the time.
struct Listener final : rti::FederateAmbassador {
  rti::Ambassador ambassador{rink_fom(), *this};
  std::vector<MatchState> states;
  std::optional<std::string> scene;
  std::optional<double> tick_s;
  std::vector<rti::Stamp> answers;
  rti::FederateHandle own;

  void joined(rti::FederateHandle handle) override { own = handle; }
  void reflect_attribute_values(rti::ObjectHandle, rti::AttributeSet attributes, rti::Bytes values,
                                const rti::Stamp&) override {
    rti::Reader reader(values);
    attributes.for_each([&](rti::AttributeHandle each) { take(each, reader); });
    EXPECT_TRUE(reader.is_at_end());
  }
  void receive_interaction(rti::InteractionClassHandle interaction_class, rti::Bytes,
                           rti::FederateHandle, const rti::Stamp& stamp) override {
    if (interaction_class == rink_model().pong) answers.push_back(stamp);
  }

 private:
  void take(rti::AttributeHandle attribute, rti::Reader& reader) {
    if (attribute == rink_model().match_state) {
      EXPECT_TRUE(exchange(reader, states.emplace_back()));
    } else if (attribute == rink_model().match_scene) {
      SceneText text;
      EXPECT_TRUE(exchange(reader, text));
      scene.emplace(reinterpret_cast<const char*>(text.text.data()), text.text.size());
    } else {
      TickPeriod period;
      EXPECT_TRUE(exchange(reader, period));
      tick_s = period.seconds;
    }
  }
};

/// An execution that hands on what it says at once.
class Hall final : public rti::Outlet {
 public:
  void enter(Listener& listener, std::string_view name) {
    const auto connection = static_cast<rti::ConnectionId>(listeners_.size());
    listeners_.push_back(&listener);
    execution_.connect(connection);
    listener.ambassador.join("rink", name, "tester");
    tick();
  }
  void tick() {
    for (std::size_t i = 0; i < listeners_.size(); ++i) {
      rti::Ambassador& ambassador = listeners_[i]->ambassador;
      execution_.receive(static_cast<rti::ConnectionId>(i), ambassador.outgoing());
      ambassador.clear_outgoing();
    }
    execution_.match();
    execution_.flush(*this);
  }
  void send(rti::ConnectionId connection, std::span<const rti::Bytes> parts) override {
    for (const rti::Bytes part : parts)
      EXPECT_TRUE(listeners_[connection]->ambassador.receive(part));
  }
  void drop(rti::ConnectionId, std::string_view why) override { ADD_FAILURE() << why; }

 private:
  rti::FederationExecution execution_{rink_fom(), rti::FederationSettings{}};
  std::vector<Listener*> listeners_;
};

struct HostedEvening : ::testing::Test {
  void SetUp() override {
    hall.enter(server, "server"), hall.enter(player, "player"), hall.enter(watcher, "watcher");
    board.emplace(server.ambassador, rink_model(), "a scene", 0.02);
    for (Listener* each : {&player, &watcher}) {
      each->ambassador.subscribe_object_class_attributes(
          rink_model().match,
          {rink_model().match_state, rink_model().match_scene, rink_model().match_tick});
      each->ambassador.subscribe_interaction_class(rink_model().pong);
    }
    hall.tick(), hall.tick();
  }
  void show(const MatchState& state, double time) {
    board->show(state, {.time = time});
    hall.tick();
  }

  Hall hall;
  Listener server, player, watcher;
  std::optional<MatchBoard> board;
};

TEST_F(HostedEvening, BeginsWithTheSceneAndTheTickForWhoeverComes) {
  EXPECT_EQ(player.scene, "a scene");
  EXPECT_EQ(player.tick_s, 0.02);
  EXPECT_TRUE(player.states.empty()) << "nothing was shown yet";
}

TEST_F(HostedEvening, IsToldWhenItsStateChangesAndOnlyThen) {
  MatchState state{.number = 1, .phase = MatchPhase::countdown, .until_s = 4.0, .winner = {}};
  show(state, 1.0), show(state, 2.0);
  EXPECT_EQ(player.states, std::vector{state});
  MatchState later = state;
  later.phase = MatchPhase::playing;
  show(later, 4.0);
  EXPECT_EQ(player.states, (std::vector{state, later}));
  show(state, 5.0);
  EXPECT_EQ(player.states.size(), 3u) << "it is another than before, if not a new one";
  EXPECT_EQ(watcher.states, player.states);
}

TEST_F(HostedEvening, AnswersWhoAsksForTheTimeAloneAndAtOnce) {
  EXPECT_FALSE(board->take_urgent());
  board->answer(player.own, 17, 3.25);
  EXPECT_TRUE(board->take_urgent());
  EXPECT_FALSE(board->take_urgent()) << "once said, once hurried";
  hall.tick();
  ASSERT_EQ(player.answers.size(), 1u);
  EXPECT_EQ(player.answers[0].time, 3.25);
  EXPECT_EQ(player.answers[0].tag, 17u);
  EXPECT_TRUE(watcher.answers.empty());
  show({.number = 1, .winner = {}}, 4.0);
  EXPECT_FALSE(board->take_urgent()) << "a state waits for the next tick";
}

}  // namespace
}  // namespace rink::game
