// Wishes on their way to node 0, and its decisions, which hold at all nodes after the same window.
#include "game/node/node_seats.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

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
  EXPECT_FALSE(first.hear(1, SeatWish{.change = SeatChange::leave}));
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

/// Three nodes, of which the first decides.
class NodeSeatsThatMayGoBack : public testing::Test {
 protected:
  NodeSeatsThatMayGoBack() {
    for (peer::PeerNumber node = 0; node < 3; ++node) {
      SeatTable table(bats, 30.0);
      table.assign(0, 0, 1);
      seats_.push_back(std::make_unique<NodeSeats>(std::move(table), node, 3, true));
    }
  }
  /// All come to the end of `window`, after which the referee decides what is to hold from `then`.
  void decide(std::uint64_t window, std::uint64_t then, peer::PeerNumber referee = 0) {
    for (peer::PeerNumber node = referee; node < 3; ++node) {
      seats_[node]->due(window, static_cast<double>(window));
      for (const SeatWish& wish : seats_[node]->take_wishes())
        EXPECT_TRUE(seats_[referee]->hear(node, wish));
    }
    for (const SeatDecision& decision : seats_[referee]->decide(then, static_cast<double>(window)))
      for (peer::PeerNumber node = referee; node < 3; ++node)
        EXPECT_TRUE(seats_[node]->hear(decision));
  }
  std::optional<std::uint32_t> answer(peer::PeerNumber node) {
    const auto answer = seats_[node]->next_answer();
    return answer ? answer->player : std::nullopt;
  }

  std::vector<std::unique_ptr<NodeSeats>> seats_;
};

TEST_F(NodeSeatsThatMayGoBack, AnswerOnceNothingCanUndoTheDecision) {
  seats_[1]->wish({.token = 5});
  decide(1, 2);
  for (std::uint64_t window = 2; window <= 3; ++window) {
    EXPECT_EQ(answer(1), std::nullopt) << window;
    decide(window, window + 1);
  }
  EXPECT_EQ(answer(1), 1u);
}

TEST_F(NodeSeatsThatMayGoBack, DecideAnewWhatALossHasUndone) {
  seats_[1]->wish({.token = 5}), seats_[2]->wish({.token = 6});
  decide(1, 2), decide(2, 3);
  EXPECT_EQ(seats_[1]->holders().size(), 2u);
  for (const auto& each : seats_) {
    each->rewind(1, 1.0);
    EXPECT_TRUE(each->holders().empty());
  }
  decide(1, 2), decide(2, 3), decide(3, 4);
  EXPECT_EQ(answer(1), 1u);
  EXPECT_EQ(answer(2), 2u);
}

TEST_F(NodeSeatsThatMayGoBack, GiveTheLostRefereesPlayersToTheNext) {
  seats_[0]->wish({.change = SeatChange::stay, .player = 0, .token = 4});
  decide(1, 2), decide(2, 3), decide(3, 4);
  for (peer::PeerNumber node = 1; node < 3; ++node) {
    seats_[node]->rewind(3, 3.0);
    const auto inherited = seats_[node]->lose({0}, 1);
    ASSERT_EQ(inherited.size(), 1u);
    EXPECT_EQ(inherited.front().player, 0u);
    EXPECT_EQ(inherited.front().token, 4u);
    EXPECT_EQ(seats_[node]->holders().at(0), 1u);
    EXPECT_TRUE(seats_[node]->lose({0}, 1).empty()) << "each once";
  }
  seats_[1]->wish({.change = SeatChange::leave, .player = 0, .token = 4});
  seats_[2]->wish({.token = 4});
  decide(3, 4, 1), decide(4, 5, 1), decide(5, 6, 1);
  EXPECT_EQ(answer(2), 0u) << "it is kept for its player";
}

}  // namespace
}  // namespace rink::game
