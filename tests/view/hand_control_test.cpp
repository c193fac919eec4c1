// Where pointer and stick hold the hand, and what is said if they are not there.
#include "game/view/hand_control.h"

#include <gmock/gmock.h>

namespace rink::view {
namespace {

using ::testing::HasSubstr;
using Kind = WindowEvent::Kind;

/// As the left player sees the field.
HandControl::Table table_seen() {
  HandControl::Table table;
  table.bat = {0.5, 0.6}, table.under = {0.7, 0.4};
  table.right = {0.0, -1.0}, table.up = {1.0, 0.0};
  table.field.length = 2.4, table.field.width = 1.2;
  return table;
}

Settings hand_settings(Control control) {
  Settings settings;
  settings.control = control;
  return settings;
}

TEST(HandControl, HasNoHandWhereKeysAreChosen) {
  HandControl hand;
  hand.hear({.kind = Kind::mouse_move, .x = 10.0, .y = 10.0});
  EXPECT_FALSE(hand.place(hand_settings(Control::keys), table_seen()));
  EXPECT_TRUE(hand.words(hand_settings(Control::keys), "", 0.0).text.empty());
}

TEST(HandControl, HoldsTheHandUnderThePointerOrWhereAScriptPutsIt) {
  const Settings settings = hand_settings(Control::pointer);
  HandControl hand;
  EXPECT_FALSE(hand.place(settings, table_seen())) << "no pointer has been seen";
  EXPECT_THAT(hand.words(settings, "", 0.0).text, HasSubstr("Move the pointer"));
  hand.hear({.kind = Kind::mouse_move, .x = 10.0, .y = 10.0});
  EXPECT_EQ(hand.place(settings, table_seen()), Vector2(0.7, 0.4));
  hand.hear({.kind = Kind::pointer, .x = 0.3, .y = 0.2});
  EXPECT_EQ(hand.place(settings, table_seen()), Vector2(0.3, 0.2));
  EXPECT_TRUE(hand.words(settings, "", 1.0).text.empty());
}

TEST(HandControl, MovesThePointersHandByTheSensitivityAboutTheMiddleOfTheOwnHalf) {
  Settings settings = hand_settings(Control::pointer);
  settings.sensitivity = 2.0;
  HandControl hand;
  hand.hear({.kind = Kind::mouse_move});
  const Vector2 place = *hand.place(settings, table_seen());
  EXPECT_NEAR((place - Vector2(0.6 + 2.0 * 0.1, 0.6 - 2.0 * 0.2)).norm(), 0.0, 1e-12);
}

/// Above the horizon no place on the table is under the pointer.
TEST(HandControl, HasNoHandWhereThePointerIsOnNoPlace) {
  HandControl hand;
  hand.hear({.kind = Kind::mouse_move});
  HandControl::Table far = table_seen();
  far.under = {INFINITY, 0.0};
  EXPECT_FALSE(hand.place(hand_settings(Control::pointer), far));
  far.under = {1e9, -1e9};
  EXPECT_EQ(hand.place(hand_settings(Control::pointer), far), Vector2(4.8, -1.2)) << "far enough";
}

TEST(HandControl, HoldsTheHandWhereTheStickPointsOnTheScreen) {
  const Settings settings = hand_settings(Control::gamepad);
  HandControl hand;
  hand.hear({.kind = Kind::gamepad, .is_down = true});
  hand.hear({.kind = Kind::stick, .x = 0.1, .y = 0.1});
  EXPECT_EQ(hand.place(settings, table_seen()), Vector2(0.5, 0.6)) << "within the dead zone";
  hand.hear({.kind = Kind::stick, .x = 1.0, .y = 0.0});
  EXPECT_NEAR(
      (*hand.place(settings, table_seen()) - Vector2(0.5, 0.6 - HandControl::stick_reach)).norm(),
      0.0, 1e-12);
}

TEST(HandControl, BeginsBeyondTheDeadZoneAtNothingAndEndsAtTheRim) {
  EXPECT_EQ(beyond_dead_zone({0.0, 0.0}, 0.0), Vector2(0.0, 0.0));
  EXPECT_EQ(beyond_dead_zone({0.12, 0.09}, 0.15), Vector2(0.0, 0.0));
  EXPECT_NEAR(beyond_dead_zone({0.0, 0.2}, 0.15).y(), 0.05 / 0.85, 1e-12);
  EXPECT_NEAR(beyond_dead_zone({1.0, 1.0}, 0.15).norm(), 1.0, 1e-12) << "corners are no further";
  EXPECT_NEAR(beyond_dead_zone({-1.0, 0.0}, 0.9).x(), -1.0, 1e-12);
}

TEST(HandControl, SaysOnceThatAGamepadIsNotThereOrIsGoneAndTheKeysGoOn) {
  const Settings settings = hand_settings(Control::gamepad);
  HandControl hand;
  EXPECT_EQ(hand.words(settings, "", 1.0).text, "No gamepad is there: the keys move your bat");
  EXPECT_FALSE(hand.words(settings, "", 1.1).is_new);
  EXPECT_TRUE(hand.words(settings, "", 8.0).text.empty()) << "after a while";
  hand.hear({.kind = Kind::gamepad, .is_down = true});
  hand.hear({.kind = Kind::stick, .x = 1.0, .y = 0.0});
  EXPECT_TRUE(hand.words(settings, "", 9.0).text.empty());
  hand.hear({.kind = Kind::gamepad, .is_down = false});
  EXPECT_FALSE(hand.place(settings, table_seen())) << "its last deflection holds nothing";
  const HandControl::Words words = hand.words(settings, "", 10.0);
  EXPECT_EQ(words.text, "The gamepad is gone: the keys go on");
  EXPECT_TRUE(words.is_new);
}

TEST(HandControl, SaysWhyAMatchTakesKeysAlone) {
  HandControl hand;
  hand.hear({.kind = Kind::mouse_move});
  EXPECT_EQ(
      hand.words(hand_settings(Control::pointer), "Hosts that share a match take keys alone", 0.0)
          .text,
      "Hosts that share a match take keys alone: the keys move your bat");
}

}  // namespace
}  // namespace rink::view
