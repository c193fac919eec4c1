// Wishes on their way to node 0, and its decisions, which hold at all nodes after the same window.
#include "game/node/node_seats.h"

#include <gtest/gtest.h>

namespace rink::game {
namespace {

constexpr std::uint32_t bats = 3;

TEST(NodeSeats, LetADecisionHoldAtAllNodesAfterItsWindow) {
  NodeSeats first(SeatTable(bats, 30.0), 0, 2), second(SeatTable(bats, 30.0), 1, 2);
  second.wish({.player = 2, .token = 5});
  for (const SeatWish& wish : second.take_wishes()) EXPECT_TRUE(first.hear(1, wish));
  EXPECT_TRUE(second.take_wishes().empty()) << "each is sent once";
  first.due(7), second.due(6);
  const std::vector<SeatDecision> decisions = first.decide(8, 0.2);
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_TRUE(first.hear(decisions.front()) && second.hear(decisions.front()));
  for (NodeSeats* node : {&first, &second}) {
    EXPECT_TRUE(node->due(7).empty());
    const std::vector<SeatDecision> due = node->due(8);
    ASSERT_EQ(due.size(), 1u);
    EXPECT_EQ(due.front().node, 1u);
    EXPECT_EQ(due.front().player, 2u);
    EXPECT_TRUE(node->due(9).empty());
  }
  EXPECT_FALSE(first.next_answer()) << "its own players did not ask";
  const auto answer = second.next_answer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->token, 5u);
  EXPECT_EQ(answer->player, 2u);
}

TEST(NodeSeats, AnswerWhoGetsNothing) {
  NodeSeats alone(SeatTable(0, 30.0), 0, 1);
  EXPECT_TRUE(alone.hear(0, {.token = 5}));
  for (const SeatDecision& decision : alone.decide(1, 0.0)) EXPECT_TRUE(alone.hear(decision));
  EXPECT_EQ(alone.due(1).size(), 1u);
  const auto answer = alone.next_answer();
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->player);
}

TEST(NodeSeats, RefuseWhatNoNodeSays) {
  NodeSeats first(SeatTable(bats, 30.0), 0, 2), second(SeatTable(bats, 30.0), 1, 2);
  EXPECT_FALSE(first.hear(1, SeatWish{.player = bats}));
  EXPECT_FALSE(first.hear(1, SeatWish{.is_leaving = true}));
  EXPECT_FALSE(second.hear(0, SeatWish{})) << "only node 0 decides";
  second.due(6);
  const SeatDecision good{.window = 8, .node = 1, .player = 0};
  SeatDecision bad = good;
  bad.window = 6;
  EXPECT_FALSE(second.hear(bad)) << "that window is over";
  bad.window = 9;
  EXPECT_FALSE(second.hear(bad)) << "no node is so far ahead";
  bad = good, bad.node = 2;
  EXPECT_FALSE(second.hear(bad));
  bad = good, bad.player = bats;
  EXPECT_FALSE(second.hear(bad));
  EXPECT_TRUE(second.hear(good));
  bad = good, bad.window = 7;
  EXPECT_FALSE(second.hear(bad)) << "before one that was heard earlier";
}

}  // namespace
}  // namespace rink::game
