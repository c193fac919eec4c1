// Settings that people edit by hand: what is right counts, what is wrong is said and stays as it
// was.
#include "game/view/settings.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.h"

namespace rink::view {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;

TEST(Settings, ReadBackWhatTheyWrite) {
  Settings settings;
  settings.keys[0] = {*key_code_from_name("j"), *key_code_from_name("l"), *key_code_from_name("I"),
                      *key_code_from_name("Left Shift")};
  settings.is_muted = true;
  settings.volume = 0.25;
  settings.control = Control::gamepad;
  settings.dead_zone = 0.5, settings.sensitivity = 2.5;
  settings.window = {800, 1000};
  settings.palette = PaletteKind::no_blue_yellow;
  settings.is_best_of_three = settings.hints_seen[1] = settings.hints_seen[4] = true;
  settings.has_effects = false, settings.has_less_motion = settings.has_music = true;
  const ReadSettings read = parse_settings(settings_text(settings), "play.toml");
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.settings, settings);
}

TEST(Settings, OfTheHandAreNamedWhereTheyAreWrong) {
  const ReadSettings read = parse_settings(
      "control = \"mouse\"\ndead_zone = 0.95\nsensitivity = 0\nvolume = 2\n", "play.toml");
  EXPECT_THAT(read.errors,
              ElementsAre(AllOf(HasSubstr("play.toml:1"),
                                HasSubstr("\"keys\", \"pointer\" or \"gamepad\"")),
                          HasSubstr("play.toml:2: dead_zone must be a number from 0 to 0.9"),
                          HasSubstr("play.toml:3: sensitivity must be a number from 0.2 to 5"),
                          HasSubstr("play.toml:4: volume must be a number from 0 to 1")));
  EXPECT_EQ(read.settings, Settings());
}

/// A file of the version before has none of them.
TEST(Settings, OfAnOlderFilePlayByKeys) {
  const ReadSettings read = parse_settings("mute = true\nvolume = 0.5\n", "play.toml");
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.settings.control, Control::keys);
}

TEST(Settings, OfANewerVersionAreSaidOnceInAPlayersWordsAndTheKnownOnesCount) {
  const ReadSettings read =
      parse_settings("version = 99\nmute = true\nsmell = \"rubber\"\nice = 3\n", "play.toml");
  EXPECT_THAT(read.errors, ElementsAre(AllOf(HasSubstr("play.toml:1: these settings are of a "
                                                       "newer Rink (version 99"),
                                             HasSubstr("what is known of them counts"))));
  EXPECT_TRUE(read.settings.is_muted);
  for (const char* version : {"0", "-1", "1.5", "\"two\""})
    EXPECT_THAT(parse_settings(std::string("version = ") + version + "\n", "play.toml").errors,
                ElementsAre(HasSubstr("version must be a whole number from 1")));
  EXPECT_THAT(parse_settings("version = 1\n", "play.toml").errors, IsEmpty());
}

TEST(Settings, OfTheWindowAndItsColoursAreNamedWhereTheyAreWrong) {
  for (const char* window : {"[1280]", "[1280, 720, 3]", "[1280, 100]", "[9000, 720]",
                             "[1280.5, 720]", "\"1280x720\"", "[\"a\", \"b\"]"})
    EXPECT_THAT(parse_settings(std::string("window = ") + window + "\n", "play.toml").errors,
                ElementsAre(HasSubstr("window must be [width, height]")))
        << window;
  for (const char* hints : {"\"move\"", "[\"jump\"]", "[3]"})
    EXPECT_THAT(parse_settings(std::string("hints_seen = ") + hints + "\n", "play.toml").errors,
                ElementsAre(HasSubstr("play.toml:1: ")))
        << hints;
  EXPECT_THAT(
      parse_settings("colours = \"pink\"\n", "play.toml").errors,
      ElementsAre(HasSubstr("colours must be \"red-blue\", \"orange-blue\" or \"red-green\"")));
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
  const ReadSettings read =
      parse_settings("mute = true\n[keys.left]\nup = \"hyper\"\ndown = \"x\"\n", "my/play.toml");
  EXPECT_THAT(read.errors, ElementsAre(AllOf(HasSubstr("my/play.toml:3"), HasSubstr("'hyper'"),
                                             HasSubstr("stays 'w'"))));
  EXPECT_TRUE(read.settings.is_muted);
  EXPECT_EQ(read.settings.keys[0][2], *key_code_from_name("w"));
  EXPECT_EQ(read.settings.keys[0][3], *key_code_from_name("x"));
}

TEST(Settings, TroublesComeInTheOrderOfTheirLinesAndNoMoreThanFitOnAScreen) {
  const ReadSettings read = parse_settings(
      "zoom = 1\n[keys.left]\nup = 7\nleft = \"hyper\"\n[keys.right]\nup = \"?\"\nforward = "
      "1\nback = 1\n",
      "play.toml");
  EXPECT_THAT(read.errors,
              ElementsAre(HasSubstr("play.toml:1: there is no setting 'zoom'"),
                          AllOf(HasSubstr("play.toml:3: expected the name of a key in quotes"),
                                HasSubstr("stays 'w'")),
                          HasSubstr("play.toml:4: there is no key 'hyper'"),
                          HasSubstr("play.toml:6: there is no key '?'"), HasSubstr("and 2 more")));
}

TEST(Settings, AFileWithTroublesIsKeptWhenNewSettingsAreWritten) {
  const test::TemporaryFolder folder("settings");
  const std::string file = folder / "play.toml";
  std::ofstream(file) << "mute = true\nmute = true\n";
  EXPECT_THAT(read_settings(file).errors, ElementsAre(HasSubstr("play.toml:2")));
  ASSERT_THAT(set_settings_aside(file), Optional(HasSubstr("play.toml.old")));
  EXPECT_FALSE(write_settings(Settings(), file));
  EXPECT_EQ(test::text_of(file + ".old"), "mute = true\nmute = true\n");
  EXPECT_THAT(read_settings(file).errors, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(file + ".new"));
}

TEST(Settings, SetAsideOverwriteNothingThatWasSetAsideBefore) {
  const test::TemporaryFolder folder("settings");
  const std::string file = folder / "play.toml";
  for (const char* name : {".old", ".old2", ".old3"}) {
    std::ofstream(file) << name;
    ASSERT_THAT(set_settings_aside(file), Optional(HasSubstr(std::string(name) + "'")));
  }
  for (const char* name : {".old", ".old2", ".old3"}) EXPECT_EQ(test::text_of(file + name), name);
}

/// Flags hold for one run: what they said is kept only if the player changes it again.
TEST(Settings, OfTheFileKeepWhatFlagsSaidOnlyIfThePlayerChangesIt) {
  Settings file;
  file.volume = 0.3;
  Settings flagged = file;
  flagged.is_muted = true, flagged.control = Control::pointer, flagged.window = {640, 480};
  Settings later = flagged;
  later.keys[1][0] = 74, later.hints_seen[2] = true, later.palette = PaletteKind::no_red_green;
  Settings kept = with_changes(file, flagged, later);
  EXPECT_FALSE(kept.is_muted);
  EXPECT_EQ(kept.control, Control::keys);
  EXPECT_EQ(kept.window, WindowPoints{});
  EXPECT_EQ(kept.volume, 0.3);
  EXPECT_EQ(kept.keys, later.keys);
  EXPECT_EQ(kept.hints_seen, later.hints_seen);
  EXPECT_EQ(kept.palette, PaletteKind::no_red_green);
  Settings unmuted = later;
  unmuted.is_muted = false, unmuted.has_music = true;
  kept = with_changes(kept, later, unmuted);
  EXPECT_TRUE(kept.has_music);
  EXPECT_EQ(with_changes(Settings(), Settings(), unmuted), unmuted) << "all that there is";
}

TEST(Settings, WhatIsNoFileOrTooLargeIsNotRead) {
  const test::TemporaryFolder folder("settings");
  EXPECT_THAT(read_settings(folder.path()).errors, ElementsAre(HasSubstr("not a file")));
  EXPECT_THAT(read_settings("/dev/zero").errors, ElementsAre(HasSubstr("not a file")));
  std::ofstream(folder / "large") << std::string(3 << 20, '#');
  EXPECT_THAT(read_settings(folder / "large").errors, ElementsAre(HasSubstr("larger than")));
  EXPECT_THAT(read_settings(folder / "none").errors, IsEmpty());
}

TEST(Settings, OneKeyCannotMeanTwoThings) {
  const ReadSettings read = parse_settings("[keys.left]\nup = \"down\"\n", "play.toml");
  EXPECT_THAT(read.errors, ElementsAre(HasSubstr("'down' is given two meanings")));
  EXPECT_EQ(read.settings, Settings());
}

TEST(Settings, WhatIsNoTomlOrNoSettingIsSaidAndDefaultsGoOn) {
  for (const char* text :
       {"volume = ", "volume = 7\n", "mute = 1\n", "colour = \"red\"\n",
        "[keys.middle]\nup = \"a\"\n", "[keys.left]\nforward = \"a\"\n", "\xff\xfe"}) {
    const ReadSettings read = parse_settings(text, "play.toml");
    EXPECT_THAT(read.errors, ElementsAre(HasSubstr("play.toml:"))) << text;
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

TEST(Settings, KeepTheAddressesThatWereJoinedLast) {
  Settings settings;
  for (const char* place : {"a:1", "b:2", "c:3", "a:1", "d:4", "e:5", "f:6"})
    remember_address(settings, place);
  EXPECT_THAT(settings.addresses, ElementsAre("f:6", "e:5", "d:4", "a:1", "c:3"));
  for (const std::string& bad : {std::string(), std::string("a b"), std::string("a\"b:1"),
                                 std::string(256, 'x'), std::string("a\nb")})
    remember_address(settings, bad);
  EXPECT_EQ(settings.addresses.front(), "f:6");
  settings.finds_matches = false;
  const ReadSettings read = parse_settings(settings_text(settings), "play.toml");
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.settings, settings);
  EXPECT_EQ(with_changes(Settings(), Settings(), settings), settings);
}

TEST(Settings, NameAddressesThatAreNone) {
  for (const char* wrong : {"addresses = 3\n", "addresses = [\"a b\"]\n", "addresses = [7]\n",
                            "addresses = [\"1\",\"2\",\"3\",\"4\",\"5\",\"6\"]\n"}) {
    const ReadSettings read = parse_settings(wrong, "play.toml");
    ASSERT_EQ(read.errors.size(), 1u) << wrong;
    EXPECT_THAT(read.errors[0], HasSubstr("play.toml:1: "));
    EXPECT_THAT(read.errors[0], HasSubstr("HOST:PORT"));
  }
}

}  // namespace
}  // namespace rink::view
