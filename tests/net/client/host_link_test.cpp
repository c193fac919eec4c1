// A connection to a host in this process: what it measures of the host's clock, and what it says
// when the host refuses, is gone or plays no match.
#include "game/net/client/host_link.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "game/net/server/match_board.h"
#include "rti/federation_execution.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "tests/net/rink_model.h"

namespace rink::game {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// How long bytes take each way, and how far the host's clock is ahead.
constexpr double way_s = 0.02, ahead_s = 1000.0;

/// A federation at "host", and in it a server that says how a match stands and answers questions
/// about the time.
class Host final : public rti::FederateAmbassador {
 public:
  Host(rti::InProcessNetwork& network, bool has_match) : hub_(network), endpoint_(network) {
    hub_.listen("host");
    host_.add(hub_);
    link_.emplace(ambassador_, endpoint_, endpoint_.connect("host"));
    links_.add(*link_);
    ambassador_.join("rink", "server", "server");
    for (int round = 0; round < 4; ++round) play(ahead_s);
    if (!has_match) return;
    board_.emplace(ambassador_, rink_model(), "", 0.01);
    MatchState first;
    first.number = 1;
    board_->show(first, {});
    play(ahead_s);
  }
  /// Takes in what has come when the host's clock shows `now_s`, and says what there is to say.
  void play(double now_s) {
    now_s_ = now_s;
    host_.advance_clock(now_s);
    for (int round = 0; round < 3; ++round) {
      host_.poll({});
      host_.match();
      host_.flush();
      endpoint_.poll({}, links_);
      link_->flush(now_s);
    }
    host_.poll({});
    host_.match();
    host_.flush();
  }
  std::size_t visitor_count() const { return execution_.federate_count() - 1; }

 private:
  void receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes,
                           rti::FederateHandle sender, const rti::Stamp& stamp) override {
    if (interaction == rink_model().ping) board_->answer(sender, stamp.tag, now_s_);
  }

  rti::InProcessEndpoint hub_, endpoint_;
  rti::FederationExecution execution_{rink_fom(), rti::FederationSettings{}};
  rti::FederationHost host_{execution_};
  rti::Ambassador ambassador_{rink_fom(), *this};
  std::optional<rti::FederateLink> link_;
  rti::FederateLinks links_;
  std::optional<MatchBoard> board_;
  double now_s_ = ahead_s;
};

struct Visitor {
  rti::InProcessEndpoint endpoint;
  Client client;
  HostLink link;

  explicit Visitor(rti::InProcessNetwork& network, const std::string& name = "guest",
                   const std::string& place = "host", bool is_player = true)
      : endpoint(network),
        client(rink_fom(), rink_model(), {.name = name, .plays_match = true}),
        link(client, endpoint, endpoint.connect(place), is_player) {}
  void exchange(double now_s) {
    link.converse(now_s);
    link.flush(now_s);
  }
};

/// The host does something halfway between two real times at which the visitor does.
void play(Host& host, Visitor& visitor, int from, int until) {
  for (int step = from; step < until; ++step) {
    const double now_s = 2 * step * way_s;
    visitor.exchange(now_s);
    host.play(now_s + way_s + ahead_s);
  }
}

/// What is sent now arrives a way later, by a clock that is ahead; a few milliseconds are to spare.
TEST(AHostLink, MeasuresTheHostsClock) {
  rti::InProcessNetwork network;
  Host host(network, true);
  Visitor visitor(network);
  EXPECT_FALSE(visitor.link.has_joined());
  play(host, visitor, 0, 100);
  EXPECT_TRUE(visitor.link.has_joined());
  EXPECT_FALSE(visitor.link.is_lost()) << visitor.link.error();
  const ServerClock& clock = visitor.link.clock();
  ASSERT_TRUE(clock.is_set());
  const double truth = 5.0 + way_s + ahead_s;
  EXPECT_GT(clock.arrival(5.0), truth);
  EXPECT_LT(clock.arrival(5.0), truth + 0.01);
  EXPECT_NEAR(clock.ping_s(), 2 * way_s, 1e-12);
  EXPECT_EQ(clock.loss(), 0.0);
}

TEST(AHostLink, AsksAHostWithoutAMatchNothing) {
  rti::InProcessNetwork network;
  Host host(network, false);
  Visitor visitor(network, "guest", "host", false);
  play(host, visitor, 0, 250);
  EXPECT_TRUE(visitor.link.has_joined());
  EXPECT_FALSE(visitor.link.clock().is_set());
  EXPECT_FALSE(visitor.link.is_lost()) << "who watches needs no match: " << visitor.link.error();
}

TEST(AHostLink, GivesAHostThreeSecondsToSayThatItPlaysAMatch) {
  rti::InProcessNetwork network;
  Host host(network, false);
  Visitor visitor(network);
  int step = 0;
  for (; !visitor.link.has_joined(); ++step) play(host, visitor, step, step + 1);
  const double joined_s = 2 * (step - 1) * way_s;
  for (; !visitor.link.is_lost() && step < 1000; ++step) play(host, visitor, step, step + 1);
  EXPECT_NEAR(2 * (step - 1) * way_s - joined_s, 3.0, 1.01 * 2 * way_s);
  EXPECT_GT(2 * (step - 1) * way_s - joined_s, 3.0);
  EXPECT_EQ(visitor.link.error(), "no match is hosted there; the game can be watched");
}

TEST(AHostLink, SaysThatNobodyListens) {
  rti::InProcessNetwork network;
  Visitor visitor(network, "guest", "nowhere");
  visitor.exchange(0.0);
  EXPECT_EQ(visitor.link.error(),
            "no answer from the host: nobody listens at in-process address 'nowhere'");
  EXPECT_FALSE(visitor.link.has_joined());
}

TEST(AHostLink, SaysWhyItIsRefused) {
  rti::InProcessNetwork network;
  Host host(network, true);
  Visitor first(network), second(network);
  play(host, first, 0, 5);
  play(host, second, 5, 10);
  EXPECT_FALSE(first.link.is_lost());
  EXPECT_THAT(second.link.error(), StartsWith("the host refuses: "));
  EXPECT_THAT(second.link.error(), HasSubstr(to_string(rti::Refusal::name_taken)));
}

TEST(AHostLink, SaysThatAHostIsGoneOrSilent) {
  for (const bool says_so : {true, false}) {
    rti::InProcessNetwork network;
    std::optional<Host> host;
    host.emplace(network, true);
    Visitor visitor(network);
    play(*host, visitor, 0, 20);
    ASSERT_FALSE(visitor.link.is_lost());
    if (says_so) host.reset();
    double now_s = 40 * way_s;
    const double from_s = now_s;
    for (; !visitor.link.is_lost() && now_s < from_s + 20.0; now_s += way_s)
      visitor.exchange(now_s);
    EXPECT_NE(visitor.link.error(), "");
    EXPECT_EQ(visitor.link.error().find("no answer"), std::string::npos) << "it had answered";
    if (says_so) EXPECT_LT(now_s - from_s, 2 * way_s);
    else EXPECT_NEAR(now_s - from_s, 5.0, 0.2) << "of silence";
  }
}

/// The host of these tests beats once a second, and says nothing else that is not asked.
TEST(AHostLink, SaysForHowLongItsHostIsSilent) {
  rti::InProcessNetwork network;
  Host host(network, true);
  Visitor visitor(network);
  play(host, visitor, 0, 20);
  EXPECT_FALSE(visitor.link.is_interrupted());
  EXPECT_LE(visitor.link.silent_s(), 4 * way_s);
  const double from_s = 2 * 19 * way_s;
  double now_s = from_s;
  for (; !visitor.link.is_interrupted() && now_s < from_s + 3.0; now_s += way_s)
    visitor.exchange(now_s);
  EXPECT_NEAR(now_s - from_s, interrupted_after_s, 3 * way_s);
  host.play(now_s + way_s + ahead_s);
  visitor.exchange(now_s + 2 * way_s);
  EXPECT_FALSE(visitor.link.is_interrupted());
  EXPECT_EQ(visitor.link.silent_s(), 0.0);
}

/// Its own process stood still: what came meanwhile is read before the silence is counted.
TEST(AHostLink, TakesItsOwnStandstillForNoSilenceOfTheHost) {
  rti::InProcessNetwork network;
  Host host(network, true);
  Visitor visitor(network);
  play(host, visitor, 0, 20);
  visitor.exchange(100.0);
  EXPECT_FALSE(visitor.link.is_interrupted());
}

TEST(AHostLink, GivesUpAHostThatAcceptsAndSaysNothing) {
  rti::InProcessNetwork network;
  rti::InProcessEndpoint mute(network);
  mute.listen("mute");
  Visitor visitor(network, "guest", "mute");
  double now_s = 0.0;
  for (; !visitor.link.is_lost() && now_s < 20.0; now_s += way_s) visitor.exchange(now_s);
  EXPECT_NEAR(now_s, 5.0, 3 * way_s);
  EXPECT_EQ(visitor.link.error(),
            "no answer from the host: it accepts the connection, but says nothing");
}

TEST(AHostLink, KeepsTheFirstReasonThatItIsGiven) {
  rti::InProcessNetwork network;
  Host host(network, true);
  Visitor visitor(network), other(network, "other");
  play(host, visitor, 0, 5);
  visitor.link.lose("the scene is none");
  play(host, visitor, 5, 30);
  EXPECT_EQ(visitor.link.error(), "the scene is none");
  other.link.lose("");
  EXPECT_EQ(other.link.error(), "the connection is lost");
}

TEST(AHostLink, TakesLeave) {
  rti::InProcessNetwork network;
  Host host(network, true);
  Visitor visitor(network), stranger(network, "stranger");
  play(host, visitor, 0, 5);
  ASSERT_EQ(host.visitor_count(), 1u);
  visitor.link.leave(1.0);
  stranger.link.leave(1.0);  // which has not joined yet
  host.play(ahead_s + 1.0);
  EXPECT_EQ(host.visitor_count(), 0u);
}

}  // namespace
}  // namespace rink::game
