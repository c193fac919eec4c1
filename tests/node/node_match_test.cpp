// Matches that nodes host together: what node 0 says, and what is shown meanwhile.
#include "game/node/node_match.h"

#include <gtest/gtest.h>

namespace rink::game {
namespace {

/// A match at node 0 and at another node, with the news on their way.
struct MatchOfTwo {
  NodeMatch first{FlowTimes{.countdown_s = 1.0, .patience_s = 5.0}},
      other{FlowTimes{.countdown_s = 9.0, .patience_s = 9.0}};

  void advance(double now_s) {
    if (first.wants_session()) first.call_session();
    if (const auto news = first.advance(now_s)) {
      EXPECT_TRUE(other.follow(*news));
    }
  }
  void begin_session() {
    ASSERT_TRUE(first.begins() && other.begins());
    first.begin_session(), other.begin_session();
  }
};

TEST(NodeMatch, BeginsASessionWhenBothPlayersAreThere) {
  MatchOfTwo nodes;
  nodes.first.take_part(0, true, 0.0);
  nodes.advance(0.5);
  EXPECT_FALSE(nodes.other.begins());
  EXPECT_EQ(nodes.other.state().number, 0u);
  nodes.first.take_part(1, true, 1.0);
  nodes.advance(1.0);
  nodes.begin_session();
  EXPECT_FALSE(nodes.other.begins()) << "one session for each match";
  EXPECT_EQ(nodes.other.state().number, 1u);
  EXPECT_EQ(nodes.other.news().state.phase, MatchPhase::countdown);
  nodes.advance(2.0);
  EXPECT_EQ(nodes.other.news().state.phase, MatchPhase::playing) << "node 0's countdown holds";
}

TEST(NodeMatch, StopsAndGoesOnForWhoeverAsks) {
  MatchOfTwo nodes;
  for (const std::uint32_t player : {0u, 1u}) nodes.first.take_part(player, true, 0.0);
  nodes.advance(0.0);
  nodes.begin_session();
  nodes.advance(1.0);
  nodes.first.apply({.kind = MatchWish::Kind::pause}, 3.0);
  nodes.advance(4.0);
  EXPECT_EQ(nodes.other.news().state.phase, MatchPhase::paused);
  EXPECT_EQ(nodes.other.news().state.clock_simulated_s, 2.0);
  nodes.first.apply({.kind = MatchWish::Kind::go_on}, 5.0);
  nodes.advance(6.0);
  EXPECT_EQ(nodes.other.news().state.phase, MatchPhase::playing);
  EXPECT_FALSE(nodes.first.is_given_up());
}

/// The last windows are shown before the next match, though that has begun.
TEST(NodeMatch, ShowsAMatchToItsEndBeforeTheNext) {
  MatchOfTwo nodes;
  for (const std::uint32_t player : {0u, 1u}) nodes.first.take_part(player, true, 0.0);
  nodes.advance(0.0);
  nodes.begin_session();
  nodes.advance(1.0);
  nodes.first.end_session(0.5, 30), nodes.other.end_session(0.5, 30);
  nodes.first.note_won(Team::left, 0.5), nodes.first.follow_win();
  nodes.advance(1.6);
  nodes.other.note_shown(29);
  EXPECT_EQ(nodes.other.state().winner, Team::left);
  EXPECT_FALSE(nodes.other.has_shown_all());
  for (const std::uint32_t player : {0u, 1u})
    nodes.first.apply({.kind = MatchWish::Kind::rematch, .player = player}, 2.0);
  nodes.advance(2.0);
  nodes.advance(2.0);
  nodes.begin_session();
  EXPECT_EQ(nodes.other.state().number, 1u);
  EXPECT_GE(nodes.other.state().clock_simulated_s, 0.5) << "all of it is shown at once";
  nodes.other.note_shown(30);
  EXPECT_TRUE(nodes.other.has_shown_all());
  EXPECT_EQ(nodes.other.state().number, 2u);
  EXPECT_FALSE(nodes.other.has_shown_all());
}

TEST(NodeMatch, IsGivenUpWhenAPlayerStaysAway) {
  MatchOfTwo nodes;
  for (const std::uint32_t player : {0u, 1u}) nodes.first.take_part(player, true, 0.0);
  nodes.advance(0.0);
  nodes.begin_session();
  nodes.advance(1.0);
  nodes.first.take_part(1, false, 2.0);
  nodes.advance(6.9);
  EXPECT_FALSE(nodes.first.is_given_up()) << "it may come back";
  nodes.advance(7.0);
  EXPECT_TRUE(nodes.first.is_given_up());
  nodes.first.end_after(61);
  nodes.advance(7.0);
  EXPECT_EQ(nodes.other.news().last_window, 61u);
  EXPECT_TRUE(nodes.other.is_last(61) && !nodes.other.is_last(60));
  EXPECT_EQ(nodes.other.news().state.winner, Team::left);
  EXPECT_FALSE(nodes.first.is_given_up()) << "that is known";
}

TEST(NodeMatch, IsOverOnceNoneFollowsThoughNobodyHasWon) {
  MatchOfTwo nodes;
  for (const std::uint32_t player : {0u, 1u}) nodes.first.take_part(player, true, 0.0);
  nodes.advance(0.0);
  nodes.begin_session();
  nodes.advance(1.0);
  nodes.other.end_session(0.5, 30);
  nodes.other.close(std::nullopt);
  EXPECT_EQ(nodes.other.state().phase, MatchPhase::over);
  EXPECT_EQ(nodes.other.state().winner, std::nullopt);
  EXPECT_EQ(nodes.other.state().clock_simulated_s, 0.5) << "all of it is shown";
}

TEST(NodeMatch, FollowsNoSessionThatWasLeftOut) {
  NodeMatch other{FlowTimes{}};
  EXPECT_FALSE(other.follow({.state = {.winner = std::nullopt}, .session = 2}));
  EXPECT_TRUE(other.follow({.state = {.winner = std::nullopt}, .session = 1}));
}

}  // namespace
}  // namespace rink::game
