// What a scene file says is what the scene is, and what is wrong with it is said by line.
#include "game/model/scene_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>

#include "game/control/game.h"
#include "tests/game/rink_scenes.h"
#include "tests/temporary_folder.h"
#include "tests/words.h"

namespace rink::game {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  return refusal_of([&] { parse_scene(text, "bad.toml"); });
}

/// The refusal of `more` after three lines of a field of 4 m x 2 m, so that `more` starts on
/// line 4.
std::string refusal_in_field(const std::string& more) {
  return refusal("[field]\nlength = 4.0\nwidth = 2.0\n" + more);
}

TEST(SceneFile, HoldsEverythingThatItSays) {
  const Scene scene = small_scene(R"(
bats_keep_to_half = true
material = "board"
[materials]
names = ["ice", "board"]
restitution = 0.5
[[materials.pair]]
between = ["ice", "board"]
restitution = 0.75
[drag]
pucks = 0.25
bats = 2.0
[match]
goals_to_win = 3
face_off_delay = 0.5
face_off_distance = 0.125
[[puck]]
name = "black"
position = [1.0, 1.5]
velocity = [-1.0, 0.5]
radius = 0.0625
mass = 0.125
material = "ice"
[[post]]
position = [2.0, 1.0]
radius = 0.25
[[bat]]
name = "left"
position = [0.5, 1.0]
half_extent = [0.125, 0.25]
mass = 2.0
thrust = 7.0
[[key]]
time = 1.5
bat = "left"
key = "up"
is_down = true
)");
  EXPECT_EQ(scene.name, "small");
  EXPECT_EQ(scene.world.field.length, 4.0);
  EXPECT_EQ(scene.world.field.goal_width, 0.5);
  EXPECT_EQ(scene.world.field.wall, 1);
  EXPECT_TRUE(scene.world.field.bats_keep_to_half);
  EXPECT_EQ(scene.world.restitution(0, 1), 0.75);
  EXPECT_EQ(scene.world.restitution(1, 1), 0.5);
  EXPECT_EQ(scene.world.puck_drag, 0.25);
  EXPECT_EQ(scene.world.bat_drag, 2.0);
  EXPECT_EQ(scene.rules.goals_to_win, 3u);
  EXPECT_EQ(scene.rules.face_off_delay, 0.5);
  EXPECT_EQ(scene.rules.face_off_distance, 0.125);
  ASSERT_EQ(scene.bodies.pucks.size(), 1u);
  EXPECT_EQ(scene.bodies.pucks[0].name, "black");
  EXPECT_EQ(scene.bodies.pucks[0].body.velocity, Vector2(-1.0, 0.5));
  EXPECT_EQ(scene.bodies.pucks[0].body.mass, 0.125);
  ASSERT_EQ(scene.bodies.bats.size(), 1u);
  EXPECT_EQ(scene.bodies.bats[0].team, Team::left);
  EXPECT_EQ(scene.bodies.bats[0].body.half, physics::Half::left);
  EXPECT_EQ(scene.bodies.bats[0].thrust, 7.0);
  ASSERT_EQ(scene.bodies.posts.size(), 1u);
  EXPECT_EQ(scene.bodies.posts[0].name, "post-0");
  EXPECT_EQ(scene.keys, (std::vector<InputEvent>{{1.5, 0, InputKind::key_down, Key::up}}));
}

TEST(SceneFile, HoldsFrictionOfTheTableAndOfSurfaces) {
  const Scene scene = small_scene(R"(
[materials]
names = ["ice", "board", "rubber"]
restitution = 0.9
friction = 0.125
tangential_restitution = 0.25
[[materials.pair]]
between = ["ice", "rubber"]
friction = 0.75
[[materials.pair]]
between = ["board", "rubber"]
restitution = 0.5
tangential_restitution = 0.5
[friction]
pucks = 0.25
[[puck]]
position = [1.0, 1.5]
spin = -3.0
)");
  EXPECT_EQ(scene.world.puck_friction, 0.25);
  ASSERT_TRUE(scene.world.surface_friction);
  EXPECT_EQ(scene.world.surface_friction->coefficient(0, 1), 0.125);
  EXPECT_EQ(scene.world.surface_friction->coefficient(2, 0), 0.75);
  EXPECT_EQ(scene.world.surface_friction->tangential_restitution(2, 0), 0.25);
  EXPECT_EQ(scene.world.surface_friction->tangential_restitution(1, 2), 0.5);
  EXPECT_EQ(scene.world.restitution(1, 2), 0.5);
  EXPECT_EQ(scene.world.restitution(0, 2), 0.9);
  EXPECT_EQ(scene.bodies.pucks[0].body.spin, -3.0);
}

TEST(SceneFile, LacksSpinWhereNoPairOfMaterialsHasFriction) {
  const Scene scene =
      small_scene("[materials]\nnames = [\"ice\"]\nfriction = 0.0\ntangential_restitution = 0.5\n");
  EXPECT_FALSE(scene.world.surface_friction);
  EXPECT_EQ(scene.world.puck_friction, 0.0);
}

TEST(SceneFile, HasAFingerprintThatTellsFrictionAndSpin) {
  const std::string materials = "[materials]\nnames = [\"ice\"]\nfriction = 0.5\n",
                    puck = "[[puck]]\nposition = [1.0, 1.0]\n";
  const std::uint64_t fingerprints[] = {
      fingerprint(small_scene(puck)), fingerprint(small_scene("[friction]\npucks = 0.25\n" + puck)),
      fingerprint(small_scene(materials + puck)),
      fingerprint(small_scene(materials + "tangential_restitution = 0.5\n" + puck)),
      fingerprint(small_scene(materials + puck + "spin = 1.0\n"))};
  for (std::size_t i = 0; i < std::size(fingerprints); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(fingerprints[i], fingerprints[j]) << i << " " << j;
}

TEST(SceneFile, RefusesKeysSoDeepThatNoParserBearsThem) {
  std::string table = "[a";
  for (int k = 0; k < 50'000; ++k) table += ".a";
  EXPECT_THAT(refusal_in_field(table + "]\n"),
              AllOf(HasSubstr("bad.toml:4"), HasSubstr("more than 1000 dots")));
}

TEST(SceneFile, RefusesFrictionThatHasNoMeaning) {
  EXPECT_THAT(refusal_in_field("[friction]\nbats = 0.1\n"),
              AllOf(HasSubstr("bad.toml:5"), HasSubstr("friction.bats is 0.1"),
                    HasSubstr("no closed form")));
  EXPECT_THAT(refusal_in_field("[friction]\npucks = -0.1\n"),
              AllOf(HasSubstr("bad.toml:5"), HasSubstr("friction.pucks is -0.1"),
                    HasSubstr("from 0 to 10000")));
  EXPECT_THAT(refusal_in_field("[friction]\npucks = inf\n"),
              AllOf(HasSubstr("bad.toml:5"), HasSubstr("friction.pucks is inf")));
  EXPECT_THAT(refusal_in_field("[materials]\nfriction = -1.0\n"),
              AllOf(HasSubstr("bad.toml:5"), HasSubstr("materials.friction is -1")));
  EXPECT_THAT(refusal_in_field("[materials]\ntangential_restitution = 1.5\n"),
              AllOf(HasSubstr("bad.toml:5"), HasSubstr("from 0 to 1")));
  EXPECT_THAT(
      refusal_in_field(
          "[materials]\nnames = [\"ice\"]\n[[materials.pair]]\nbetween = [\"ice\", \"ice\"]\n"),
      AllOf(HasSubstr("bad.toml:6"), HasSubstr("restitution, friction or")));
  EXPECT_THAT(
      refusal_in_field("[[puck]]\nposition = [1.0, 1.0]\nspin = 2.0\n"),
      AllOf(HasSubstr("bad.toml:6"), HasSubstr("spin is 2"), HasSubstr("friction above 0")));
}

TEST(SceneFile, RefusesWhatIsNotTomlByLine) {
  EXPECT_THAT(refusal("[field]\nlength = = 3\n"),
              AllOf(HasSubstr("bad.toml:2"), HasSubstr("not TOML")));
}

TEST(SceneFile, RefusesUnknownKeysAndNamesTheNearestKnownOne) {
  EXPECT_THAT(
      refusal("[field]\nlenght = 4.0\nlength = 4.0\nwidth = 2.0\n"),
      AllOf(HasSubstr("bad.toml:2"), HasSubstr("lenght"), HasSubstr("did you mean length?")));
  EXPECT_THAT(refusal_in_field("[[puk]]\nposition = [1.0, 1.0]\n"),
              AllOf(HasSubstr("bad.toml:4"), HasSubstr("did you mean puck?")));
}

TEST(SceneFile, RefusesMissingKeys) {
  EXPECT_THAT(refusal("name = \"empty\"\n"), AllOf(HasSubstr("bad.toml:1"), HasSubstr("[field]")));
  EXPECT_THAT(refusal("\n[field]\nwidth = 2.0\n"),
              AllOf(HasSubstr("bad.toml:2"), HasSubstr("length")));
  EXPECT_THAT(refusal_in_field("[[puck]]\nradius = 0.1\n"),
              AllOf(HasSubstr("bad.toml:4"), HasSubstr("position")));
}

TEST(SceneFile, RefusesImpossiblePitchesByLine) {
  for (const std::string value : {"0.0", "-2.0", "nan", "inf", "-inf"}) {
    EXPECT_THAT(refusal("[field]\nlength = " + value + "\nwidth = 2.0\n"),
                AllOf(HasSubstr("bad.toml:2"), HasSubstr("field.length is " + value),
                      HasSubstr("from 0.001 to 1e+09")));
    EXPECT_THAT(refusal("[field]\nlength = 4.0\nwidth = " + value + "\n"),
                AllOf(HasSubstr("bad.toml:3"), HasSubstr("field.width is " + value),
                      HasSubstr("from 0.001 to 1e+09")));
  }
  for (const std::string value : {"-0.5", "2.1", "nan", "inf"})
    EXPECT_THAT(refusal_in_field("goal_width = " + value + "\n"),
                AllOf(HasSubstr("bad.toml:4"), HasSubstr("field.goal_width is " + value),
                      HasSubstr("from 0 to 2")));
  EXPECT_THAT(
      refusal("[field]\nlength = 0.1\nwidth = 0.05\n[[puck]]\nposition = [0.05, 0.025]\n"),
      AllOf(HasSubstr("bad.toml:4"), HasSubstr("not wholly within the field of 0.1 m x 0.05 m")));
}

struct BadValue {
  const char* text;
  const char* line;
  const char* key;
  const char* expected;
};

class BadValues : public ::testing::TestWithParam<BadValue> {};

TEST_P(BadValues, AreRefusedWithLineKeyAndWhatWasExpected) {
  const std::string why = refusal_in_field(GetParam().text);
  EXPECT_THAT(why, AllOf(HasSubstr(GetParam().line), HasSubstr(GetParam().key),
                         HasSubstr(GetParam().expected)));
}

INSTANTIATE_TEST_SUITE_P(
    SceneFile, BadValues,
    ::testing::Values(
        BadValue{"goal_width = 2.5\n", "bad.toml:4", "field.goal_width is 2.5", "from 0 to 2"},
        BadValue{"goal_width = nan\n", "bad.toml:4", "field.goal_width is nan", "a number"},
        BadValue{"material = \"felt\"\n", "bad.toml:4", "felt", "plain"},
        BadValue{"[drag]\npucks = -0.1\n", "bad.toml:5", "drag.pucks is -0.1", "from 0 to 10000"},
        BadValue{"[drag]\nbats = inf\n", "bad.toml:5", "drag.bats", "a number"},
        BadValue{"[materials]\nrestitution = 1.5\n", "bad.toml:5", "materials.restitution is 1.5",
                 "from 0 to 1"},
        BadValue{"[materials]\nnames = [\"a\", \"a\"]\n", "bad.toml:5", "materials.names",
                 "each name once"},
        BadValue{"[match]\ngoals_to_win = 0\n", "bad.toml:5", "match.goals_to_win is 0", "from 1"},
        BadValue{"[match]\ngoals_to_win = 2.5\n", "bad.toml:5", "match.goals_to_win is 2.5",
                 "a whole number"},
        BadValue{"[match]\nface_off_delay = 0.0\n", "bad.toml:5", "match.face_off_delay is 0",
                 "from 1e-09 to 1e+09"},
        BadValue{"[[puck]]\nposition = [1.0]\n", "bad.toml:5", "puck.position", "two numbers"},
        BadValue{"[[puck]]\nposition = [1.0, nan]\n", "bad.toml:5", "puck.position", "two numbers"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nvelocity = [inf, 0.0]\n", "bad.toml:6",
                 "puck.velocity", "from -1e+06 to 1e+06"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nradius = 0.0\n", "bad.toml:6",
                 "puck.radius is 0", "from 1e-05 to 1e+09"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nmass = -1.0\n", "bad.toml:6", "puck.mass is -1",
                 "from 1e-06 to 1e+14"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nradius = \"big\"\n", "bad.toml:6",
                 "puck.radius is 'big'", "a number"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nradius = nan\n", "bad.toml:6",
                 "puck.radius is nan", "from 1e-05 to 1e+09"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nradius = -0.04\n", "bad.toml:6",
                 "puck.radius is -0.04", "from 1e-05 to 1e+09"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nmass = 0.0\n", "bad.toml:6", "puck.mass is 0",
                 "from 1e-06 to 1e+14"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nmass = nan\n", "bad.toml:6", "puck.mass is nan",
                 "from 1e-06 to 1e+14"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nvelocity = [0.0, nan]\n", "bad.toml:6",
                 "puck.velocity", "from -1e+06 to 1e+06"},
        BadValue{"[[puck]]\nposition = [1.0, -inf]\n", "bad.toml:5", "puck.position",
                 "two numbers"},
        BadValue{"[[puck]]\nposition = [1.0, -1.0]\n", "bad.toml:4", "puck-0 at [1, -1]",
                 "not wholly within the field"},
        BadValue{"[[post]]\nposition = [1.0, 1.0]\nradius = -0.1\n", "bad.toml:6",
                 "post.radius is -0.1", "from 0 to 1e+09"},
        BadValue{"[[post]]\nposition = [1.0, 2.5]\nradius = 0.1\n", "bad.toml:4", "post-0",
                 "not wholly within the field"},
        BadValue{"[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [-0.1, 0.1]\n", "bad.toml:6",
                 "bat.half_extent", "from 1e-05 to 1e+09"},
        BadValue{"[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.1, nan]\n", "bad.toml:6",
                 "bat.half_extent", "from 1e-05 to 1e+09"},
        BadValue{"[[bat]]\nposition = [2.0, 1.0]\nhalf_extent = [0.1, 1.1]\n", "bad.toml:4",
                 "bat-0", "not wholly within the field"},
        BadValue{"[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.1, 0.1]\nthrust = nan\n",
                 "bad.toml:7", "bat.thrust is nan", "from 0 to 10000"},
        BadValue{"[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.1, 0.1]\nmass = -0.5\n",
                 "bad.toml:7", "bat.mass is -0.5", "from 1e-06 to 1e+14"},
        BadValue{"[[population]]\nkind = \"puck\"\ncount = 3\nradius = 0.0\n", "bad.toml:7",
                 "population.radius is 0", "from 1e-05 to 1e+09"},
        BadValue{"[[population]]\nkind = \"puck\"\ncount = 3\nmass = nan\n", "bad.toml:7",
                 "population.mass is nan", "from 1e-06 to 1e+14"},
        BadValue{"[[population]]\nkind = \"puck\"\ncount = 3\nmean_speed = -1.0\n", "bad.toml:7",
                 "population.mean_speed is -1", "from 0 to 1e+06"},
        BadValue{"[[population]]\nkind = \"puck\"\ndensity = inf\n", "bad.toml:6",
                 "population.density is inf", "from 0 up"},
        BadValue{"[[puck]]\nposition = [3.99, 1.0]\n", "bad.toml:4", "puck-0",
                 "not wholly within the field of 4 m x 2 m"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\n[[puck]]\nposition = [1.05, 1.0]\n",
                 "bad.toml:6", "puck-1", "overlaps puck-0"},
        BadValue{"[[post]]\nposition = [1.0, 1.0]\nradius = 0.1\n[[bat]]\nposition = [1.1, "
                 "1.0]\nhalf_extent = [0.1, 0.1]\n",
                 "bad.toml:7", "bat-0", "overlaps post-0"},
        BadValue{"[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.1, 0.0]\n", "bad.toml:6",
                 "bat.half_extent", "from 1e-05 to 1e+09"},
        BadValue{"[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.1, 0.1]\nteam = \"red\"\n",
                 "bad.toml:7", "bat.team is 'red'", "left, right, none"},
        BadValue{
            "bats_keep_to_half = true\n[[bat]]\nposition = [1.95, 1.0]\nhalf_extent = [0.1, 0.1]\n",
            "bad.toml:5", "bat-0", "its team's half"},
        BadValue{"[[puck]]\nname = \"p\"\nposition = [1.0, 1.0]\n[[puck]]\nname = \"p\"\nposition "
                 "= [2.0, 1.0]\n",
                 "bad.toml:7", "p is taken", "each name once"},
        BadValue{"[[population]]\nkind = \"disc\"\ncount = 3\n", "bad.toml:5",
                 "population.kind is 'disc'", "puck, bat, post"},
        BadValue{"[[population]]\nkind = \"puck\"\n", "bad.toml:4", "population",
                 "either count or density"},
        BadValue{"[[population]]\nkind = \"puck\"\ncount = -3\n", "bad.toml:6",
                 "population.count is -3", "a whole number from 0"},
        BadValue{"[[population]]\nkind = \"puck\"\ncount = 3\nradius = [0.2, 0.1]\n", "bad.toml:7",
                 "population.radius", "in this order"},
        BadValue{"[[population]]\nkind = \"puck\"\ncount = 100000\n", "bad.toml:4", "pucks-0",
                 "does not fit"},
        BadValue{"[[population]]\nkind = \"bat\"\ncount = 3\nradius = 0.1\n", "bad.toml:7",
                 "radius", "unknown key"},
        BadValue{"[[key]]\ntime = 1.0\nbat = \"ghost\"\nkey = \"up\"\nis_down = true\n",
                 "bad.toml:6", "key.bat is 'ghost'", "the name of a bat"},
        BadValue{"[[key]]\ntime = -1.0\nbat = \"ghost\"\n", "bad.toml:5", "key.time is -1",
                 "from 0 to 1e+09"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nvelocity = [1e300, 0.0]\n", "bad.toml:6",
                 "puck.velocity is [1e+300, 0.0]", "from -1e+06 to 1e+06"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nradius = 1e-300\n", "bad.toml:6",
                 "puck.radius is 1e-300", "from 1e-05"},
        BadValue{"[[puck]]\nposition = [1.0, 1.0]\nmass = 1e-300\n", "bad.toml:6",
                 "puck.mass is 1e-300", "from 1e-06"},
        BadValue{"[materials]\nfriction = 1e300\n[[puck]]\nposition = [1.0, 1.0]\n", "bad.toml:5",
                 "materials.friction is 1e+300", "from 0 to 1e+06"},
        BadValue{"[materials]\nfriction = 1.0\n[[puck]]\nposition = [1.0, 1.0]\nspin = 1e300\n",
                 "bad.toml:8", "puck.spin is 1e+300", "from -1e+09 to 1e+09"},
        BadValue{"[drag]\npucks = 1e300\n", "bad.toml:5", "drag.pucks is 1e+300",
                 "from 0 to 10000"},
        BadValue{"[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.1, 0.1]\nthrust = 1e300\n",
                 "bad.toml:7", "bat.thrust is 1e+300", "from 0 to 10000"},
        BadValue{"[[population]]\nkind = \"puck\"\ncount = 3\nmean_speed = 1e300\n", "bad.toml:7",
                 "population.mean_speed is 1e+300", "from 0 to 1e+06"}),
    [](const auto& value) {
      return test::words(value.param.key) + "_" + std::to_string(value.index);
    });

TEST(SceneFile, MayAllowOverlapAtTheStartButNotBodiesOutsideTheField) {
  const std::string field =
      "allow_overlap = true\n[field]\nlength = 4.0\nwidth = 2.0\n[[puck]]\nposition = [1.0, "
      "1.0]\nvelocity = [1.0, 0.0]\n[[puck]]\n";
  Game game(parse_scene(field + "position = [1.05, 1.0]\n", "overlap.toml"));
  game.advance(0.0);
  EXPECT_EQ(game.world().counters().disc_impacts, 1u);
  EXPECT_NEAR(game.world().max_overlap(), 0.03, 1e-15);
  try {
    parse_scene(field + "position = [3.99, 1.0]\n", "overlap.toml");
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("overlap.toml:8"), HasSubstr("not wholly within the field")));
  }
}

TEST(SceneFile, NamesThePathThatCannotBeRead) {
  try {
    load_scene("no/such/scene.toml");
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/such/scene.toml: cannot be read"));
  }
}

TEST(SceneFile, SaysOfAnEmptyFileWhatItLacks) {
  const test::TemporaryFolder folder("scene");
  const std::string file = (folder.path() / "empty.toml").string();
  std::ofstream(file).flush();
  EXPECT_THAT(refusal_of([&] { load_scene(file); }),
              AllOf(HasSubstr("empty.toml:"), HasSubstr("[field]")));
}

TEST(SceneFile, FindsPresetsBesideTheBinaryAndNamesThemWhenAskedForAnother) {
  EXPECT_EQ(load_scene("match").name, "match");
  EXPECT_THAT(preset_names(), ::testing::IsSupersetOf({"crowd", "match"}));
  try {
    load_scene("croud");
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("croud"), HasSubstr("crowd"), HasSubstr("match")));
  }
}

}  // namespace
}  // namespace rink::game
