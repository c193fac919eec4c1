// The way of a client into the game, and the ways on which it does not get there.
#include "game/net/client/joining.h"

#include <gtest/gtest.h>

namespace rink::game {
namespace {

using State = Joining::State;

Joining seated() {
  Joining joining;
  joining.offer({.bat = 3, .position = {1.0f, 2.0f}});
  joining.sit_down();
  return joining;
}

TEST(Joining, GoesFromTheSeatByTheBarrierIntoTheGame) {
  Joining joining = seated();
  EXPECT_EQ(joining.state(), State::seated);
  EXPECT_EQ(joining.seat()->bat, 3u);
  joining.play();
  EXPECT_EQ(joining.state(), State::seated) << "it does not see its bat yet";
  joining.see_bat();
  EXPECT_EQ(joining.state(), State::ready);
  joining.play();
  EXPECT_EQ(joining.state(), State::playing);
}

TEST(Joining, FollowsACallOnceItIsReady) {
  Joining joining = seated();
  joining.call();
  EXPECT_FALSE(joining.take_call());
  joining.see_bat();
  EXPECT_TRUE(joining.take_call());
  EXPECT_FALSE(joining.take_call());
}

TEST(Joining, EndsWhereNoBatIsFree) {
  Joining joining;
  EXPECT_FALSE(joining.offer({}));
  EXPECT_EQ(joining.state(), State::refused);
  EXPECT_EQ(joining.error(), "no bat is free");
  EXPECT_FALSE(joining.refusal()) << "the RTI had let it in";
}

TEST(Joining, IgnoresASecondOffer) {
  Joining joining = seated();
  EXPECT_TRUE(joining.offer({}));
  EXPECT_TRUE(joining.offer({.bat = 4, .position = {}}));
  EXPECT_EQ(joining.seat()->bat, 3u);
  EXPECT_EQ(joining.state(), State::seated);
}

TEST(Joining, TellsWhyItIsRefusedOrLost) {
  Joining joining;
  joining.refuse(rti::Refusal::name_taken, "somebody is called so");
  EXPECT_EQ(joining.state(), State::refused);
  EXPECT_EQ(joining.refusal(), rti::Refusal::name_taken);
  joining.lose("the line is dead");
  EXPECT_EQ(joining.state(), State::lost);
  EXPECT_EQ(joining.error(), "the line is dead");
}

TEST(Joining, OfOneWhoWatchesNeedsNoBat) {
  Joining joining;
  joining.watch();
  EXPECT_EQ(joining.state(), State::playing);
  EXPECT_EQ(joining.seat()->bat, SeatOffer::no_bat);
}

}  // namespace
}  // namespace rink::game
