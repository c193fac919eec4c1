// Bats of nodes' players: who gets which, and for how long one is kept.
#include "game/node/seat_table.h"

#include <gtest/gtest.h>

namespace rink::game {
namespace {

constexpr double lease_s = 30.0;
constexpr std::uint64_t ann = 11, ben = 12;

std::uint32_t given(SeatTable& table, peer::PeerNumber node, const SeatWish& wish,
                    double now_s = 0.0) {
  const SeatDecision decision = table.decide(node, wish, now_s);
  EXPECT_TRUE(decision.answers(wish) && decision.node == node);
  return decision.player;
}

void leave(SeatTable& table, peer::PeerNumber node, std::uint32_t player, std::uint64_t token,
           double now_s) {
  const SeatWish wish{.change = SeatChange::leave, .player = player, .token = token};
  EXPECT_TRUE(table.decide(node, wish, now_s).answers(wish));
}

TEST(SeatTable, GivesABatThatTwoWantToTheFirstAndAnotherToTheSecond) {
  SeatTable table(4, lease_s);
  table.assign(0, 0, 1), table.assign(1, 1, 1);
  EXPECT_EQ(given(table, 1, {.player = 3, .token = ann}), 3u);
  EXPECT_EQ(given(table, 0, {.player = 3, .token = ben}), 2u);
  EXPECT_EQ(given(table, 0, {.token = 13}), no_player) << "all have players";
}

TEST(SeatTable, KeepsTheBatOfWhoHasLeftForItAlone) {
  SeatTable table(2, lease_s);
  EXPECT_EQ(given(table, 0, {.token = ann}), 0u);
  leave(table, 0, 0, ann, 5.0);
  EXPECT_EQ(given(table, 1, {.player = 0, .token = ben}, 6.0), 1u);
  EXPECT_EQ(given(table, 1, {.player = 0, .token = 13}, 34.9), no_player) << "29.9 s later";
  EXPECT_EQ(given(table, 1, {.token = ann}, 34.9), 0u) << "at another node than before";
}

TEST(SeatTable, TellsTwoOfOneNameByTheNodesThatTheyLeft) {
  SeatTable table(2, lease_s);
  for (const peer::PeerNumber node : {0u, 1u}) EXPECT_EQ(given(table, node, {.token = ann}), node);
  for (const peer::PeerNumber node : {0u, 1u}) leave(table, node, node, ann, 5.0);
  EXPECT_EQ(given(table, 1, {.token = ann}, 6.0), 1u);
  EXPECT_EQ(given(table, 0, {.token = ann}, 6.0), 0u);
}

TEST(SeatTable, GivesTheBatToOthersAfterTheLease) {
  SeatTable table(1, lease_s);
  EXPECT_EQ(given(table, 0, {.token = ann}), 0u);
  leave(table, 0, 0, ann, 5.0);
  EXPECT_EQ(given(table, 1, {.token = ben}, 35.0), 0u);
  EXPECT_EQ(given(table, 0, {.token = ann}, 35.0), no_player);
}

TEST(SeatTable, KeepsNothingForNobody) {
  SeatTable table(1, lease_s);
  table.assign(0, 0, 1);
  leave(table, 0, 0, SharedPlay::nobody, 5.0);
  EXPECT_EQ(given(table, 1, {.token = ben}, 5.0), 0u);
}

TEST(SeatTable, LetsNoNodeLeaveTheBatOfAnother) {
  SeatTable table(1, lease_s);
  table.assign(1, 0, 1);
  leave(table, 0, 0, ann, 1.0);
  leave(table, 1, 7, ann, 1.0);
  EXPECT_EQ(given(table, 0, {.token = ann}, 1.0), no_player);
}

}  // namespace
}  // namespace rink::game
