// Settings that people edit by hand: what is right counts, what is wrong is said and stays as it was.
#include "game/view/settings.h"

#include <gmock/gmock.h>

namespace rink::view {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Settings, ReadBackWhatTheyWrite) {
  Settings settings;
  settings.keys[0] = {*key_code_from_name("j"), *key_code_from_name("l"), *key_code_from_name("I"), *key_code_from_name("Left Shift")};
  settings.is_muted = true;
  settings.volume = 0.25;
  const ReadSettings read = parse_settings(settings_text(settings), "play.toml");
  EXPECT_THAT(read.troubles, IsEmpty());
  EXPECT_EQ(read.settings, settings);
}

TEST(Settings, EveryKeyHasOneNameAndTheNameOneKey) {
  int count = 0;
  for (KeyCode code = 0; code < 400; ++code)
    if (const auto name = key_code_name(code)) {
      EXPECT_EQ(key_code_from_name(*name), code) << *name;
      ++count;
    }
  EXPECT_GT(count, 90);
}

TEST(Settings, AnUnknownKeyNameIsSaidWithFileAndLineAndTheOthersCount) {
  const ReadSettings read = parse_settings("mute = true\n[keys.left]\nup = \"hyper\"\ndown = \"x\"\n", "my/play.toml");
  EXPECT_THAT(read.troubles, ElementsAre(AllOf(HasSubstr("my/play.toml:3"), HasSubstr("'hyper'"), HasSubstr("stays 'w'"))));
  EXPECT_TRUE(read.settings.is_muted);
  EXPECT_EQ(read.settings.keys[0][2], *key_code_from_name("w"));
  EXPECT_EQ(read.settings.keys[0][3], *key_code_from_name("x"));
}

TEST(Settings, OneKeyCannotMeanTwoThings) {
  const ReadSettings read = parse_settings("[keys.left]\nup = \"down\"\n", "play.toml");
  EXPECT_THAT(read.troubles, ElementsAre(HasSubstr("'down' is given two meanings")));
  EXPECT_EQ(read.settings, Settings());
}

TEST(Settings, WhatIsNoTomlOrNoSettingIsSaidAndDefaultsGoOn) {
  for (const char* text : {"volume = ", "volume = 7\n", "mute = 1\n", "colour = \"red\"\n", "[keys.middle]\nup = \"a\"\n", "[keys.left]\nforward = \"a\"\n", "\xff\xfe"}) {
    const ReadSettings read = parse_settings(text, "play.toml");
    EXPECT_THAT(read.troubles, ElementsAre(HasSubstr("play.toml:"))) << text;
    EXPECT_EQ(read.settings, Settings()) << text;
  }
}

TEST(Settings, EveryKeyOfBothPlayersMeansItsDirection) {
  const Settings settings;
  for (std::uint32_t hand = 0; hand < 2; ++hand)
    for (const game::Key key : game::all_keys) {
      const auto found = bound(settings, settings.keys[hand][static_cast<std::size_t>(key)]);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->hand, hand);
      EXPECT_EQ(found->key, key);
    }
  EXPECT_FALSE(bound(settings, *key_code_from_name("q")));
}

}  // namespace
}  // namespace rink::view
