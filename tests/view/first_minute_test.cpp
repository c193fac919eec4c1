// What a player is told at first, and no longer once it was used; and who wins a best of three.
#include "game/view/first_minute.h"

#include <gmock/gmock.h>

#include "tests/view/sights.h"

namespace rink::view {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string told(const FirstMinute& first, const MatchSight& sight, const Settings& settings) {
  Picture words;
  first.add_to(sight, settings, true, words);
  std::string all;
  for (const Text& text : words.texts) all += text.words + '\n';
  return all;
}

TEST(TheFirstMinute, TellsTheRulesInThreeLinesUntilTheyWereSeenForSixSeconds) {
  FirstMinute first;
  Settings settings;
  MatchSight sight = match_sight();
  sight.phase = Phase::countdown;
  EXPECT_FALSE(first.look(sight, 1.0, settings));
  EXPECT_EQ(told(first, sight, settings),
            "Shoot the puck into the goal across, and guard your own\n"
            "W A S D or the arrows move your bat; each stays in its half\n"
            "Who scores 5 goals first wins\n");
  sight.phase = Phase::playing;
  for (double now = 4.0; now < 4.0 + FirstMinute::rules_s; now += 0.5) {
    EXPECT_FALSE(first.look(sight, now, settings));
    EXPECT_THAT(told(first, sight, settings), HasSubstr("5 goals"));
  }
  EXPECT_TRUE(first.look(sight, 10.1, settings)) << "settings are to be kept";
  EXPECT_FALSE(first.look(sight, 10.2, settings));
  EXPECT_THAT(told(first, sight, settings), Not(HasSubstr("5 goals")));
  sight.phase = Phase::countdown;
  EXPECT_THAT(told(first, sight, settings), IsEmpty());
}

TEST(TheFirstMinute, HintsAtEachKeyUntilItWasUsed) {
  FirstMinute first;
  Settings settings;
  settings.hints_seen[0] = true;
  const MatchSight sight = match_sight();
  const std::pair<Hint, const char*> hints[] = {{Hint::move, "W A S D or"},
                                                {Hint::pause, "Esc: pause"},
                                                {Hint::camera, "C: camera"},
                                                {Hint::help, "F1: all keys"}};
  for (const auto& [hint, words] : hints) {
    EXPECT_THAT(told(first, sight, settings), HasSubstr(words));
    EXPECT_TRUE(FirstMinute::use(hint, settings));
    EXPECT_FALSE(FirstMinute::use(hint, settings));
    EXPECT_THAT(told(first, sight, settings), Not(HasSubstr(words)));
  }
  EXPECT_THAT(told(first, sight, settings), IsEmpty());
}

TEST(TheFirstMinute, NamesKeysAndControlsAsTheyAreSet) {
  FirstMinute first;
  Settings settings;
  settings.hints_seen[0] = true;
  settings.keys[0][2] = *key_code_from_name("u");
  EXPECT_THAT(told(first, match_sight(), settings), HasSubstr("U A S D or"));
  EXPECT_EQ(all_keys(settings).front().first, "U A S D");
  settings.control = Control::pointer;
  EXPECT_THAT(told(first, match_sight(), settings), HasSubstr("follows the pointer"));
}

/// One match after the other is won by these.
TEST(ASeries, IsWonByTwoOfThreeAndBeginsAnewAfterThat) {
  using game::Team;
  Series series;
  MatchSight sight = match_sight();
  const auto play = [&](Team winner) {
    sight.phase = Phase::countdown, sight.winner.reset();
    series.look(sight);
    sight.phase = Phase::playing;
    series.look(sight);
    sight.phase = Phase::over, sight.winner = winner;
    for (int k = 0; k < 3; ++k) series.look(sight);
  };
  const auto line = [&] {
    Picture words;
    series.add_to(sight, palette_of(PaletteKind::standard), words);
    return words.texts.empty() ? std::string() : words.texts.front().words;
  };
  play(Team::left);
  EXPECT_EQ(line(), "Best of three: 1 : 0");
  play(Team::right);
  EXPECT_FALSE(series.winner());
  play(Team::right);
  EXPECT_EQ(series.winner(), Team::right);
  EXPECT_EQ(line(), "Blue wins the best of three 1 : 2");
  play(Team::left);
  EXPECT_EQ(series.wins(Team::left), 1u);
  EXPECT_EQ(series.wins(Team::right), 0u);
  sight.phase = Phase::playing;
  EXPECT_EQ(line(), "");
}

}  // namespace
}  // namespace rink::view
