// The command rink play, run as its users run it, without a display.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "game/control/game.h"
#include "game/control/key_log_file.h"
#include "game/model/scene_file.h"
#include "game/net/scene_choice.h"
#include "game/process/process.h"
#include "game/view/picture_of.h"
#include "game/view/render/image_file.h"
#include "game/view/render/offscreen.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/places.h"
#include "tests/reserved_port.h"
#include "tests/temporary_folder.h"

namespace rink::view {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

bool can_draw() {
  static const bool can = [] {
    try {
      const OffscreenContext context;
      return true;
    } catch (const GraphicsError&) {
      return false;
    }
  }();
  return can;
}

class PlayCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_draw()) GTEST_SKIP() << "no EGL with Mesa's surfaceless platform here";
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// The exit status; what was said on standard error is in `said_`.
  int play(const std::string& arguments, const std::string& script = {},
           const std::string& further = {}) {
    std::ofstream(file("script")) << script;
    const std::string command =
        "cd " + folder_.path().string() +
        " && env -u DISPLAY -u WAYLAND_DISPLAY XDG_CONFIG_HOME=" + folder_.path().string() +
        " XDG_DATA_HOME=" + folder_.path().string() + " " + test::binary_folder() +
        "/bin/rink-play " + arguments +
        (script.empty() ? "" : " --offscreen --size 640x360 --script script") + further + " 2>err";
    const int status = std::system(command.c_str());
    said_ = test::text_of(file("err"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  test::TemporaryFolder folder_{"play"};
  std::string said_;
};

TEST_F(PlayCommand, TakesTheSamePicturesForTheSameScript) {
  const std::string script = "0.5 tap c\n3.2 down w\n4 picture a.png\n4.5 up w\n5 end\n";
  ASSERT_EQ(play("--bot expert", script), 0) << said_;
  const Image first = read_png(file("a.png"));
  ASSERT_EQ(play("--bot expert", script), 0) << said_;
  EXPECT_EQ(first.pixels, read_png(file("a.png")).pixels);
  EXPECT_EQ(first.width, 640);
}

/// What was done in a recorded match, found by playing it again.
struct Played {
  explicit Played(const std::string& file) : log(game::read_key_log(std::filesystem::path(file))) {
    game::Game game(game::load_scene("match"));
    const physics::BodyId bot = *game.bat(1);
    game.record_events(true);
    for (const game::InputEvent& event : log.events) {
      game.submit(event);
      ++(event.player == 0 ? own_keys : bot_keys);
    }
    game.advance(log.until.value());
    for (const physics::Event& event : game.events())
      touches +=
          event.kind == physics::EventKind::puck_bat && (event.body == bot || event.other == bot)
              ? 1
              : 0;
    goals = game.score().left + game.score().right;
    is_as_recorded = game.hash() == log.hash;
  }
  game::KeyLog log;
  int own_keys = 0, bot_keys = 0, touches = 0;
  std::uint32_t goals = 0;
  bool is_as_recorded = false;
};

/// The person holds a key for a second and then stands: all else is the bot's. Countdown to 3.9 s,
/// pause at 16 s, all in frames of 1/60 s.
TEST_F(PlayCommand, PlaysAgainstEachBotFromTheMenuToThePauseAndBack) {
  std::uint32_t goals = 0;
  for (int bot = 0; bot < 3; ++bot) {
    const std::string downs = bot == 0   ? ""
                              : bot == 1 ? "0.6 tap down\n"
                                         : "0.6 tap down\n0.7 tap down\n";
    const std::string script =
        "0.2 tap down\n0.4 tap enter\n" + downs + "0.8 tap enter\n5 down w\n6 up w\n" +
        "16 tap escape\n16.2 tap down\n16.3 tap down\n16.5 tap enter\n17 end\n";
    ASSERT_EQ(play("--records kept-" + std::to_string(bot), script), 0) << said_;
    ASSERT_TRUE(std::filesystem::exists(file("kept-" + std::to_string(bot) + "/match-1.keys")))
        << "bot " << bot;
    const Played played(file("kept-" + std::to_string(bot) + "/match-1.keys"));
    EXPECT_TRUE(played.is_as_recorded);
    EXPECT_NEAR(*played.log.until, 12.1, 0.3) << "it was stopped where the script says";
    EXPECT_EQ(played.own_keys, 2);
    EXPECT_GT(played.bot_keys, 12) << "bot " << bot << ": one a second at least";
    EXPECT_GE(played.touches, 1) << "bot " << bot << " plays the puck";
    goals += played.goals;
  }
  EXPECT_GE(goals, 1u) << "somebody scores against one who stands";
}

/// A match by pointer, its record and its hash; then one by a stick whose gamepad is pulled out.
TEST_F(PlayCommand, PlaysByPointerAndByStickAndGoesOnByKeysWhenTheGamepadIsGone) {
  std::string hand;
  for (int k = 0; k < 40; ++k)
    hand += std::to_string(3.2 + 0.1 * k) + " pointer " + std::to_string(0.3 + 0.01 * k) + " " +
            std::to_string(k % 10 < 5 ? 0.4 : 0.8) + "\n";
  ASSERT_EQ(play("--bot beginner --control pointer --records by-pointer", hand + "8 end\n"), 0)
      << said_;
  ASSERT_EQ(play("--bot beginner --control gamepad --records by-stick",
                 "0.1 gamepad on\n3.2 stick 0 1\n3.6 stick 1 0\n4 gamepad off\n5 down w\n6 up "
                 "w\n7 end\n"),
            0)
      << said_;
  EXPECT_THAT(said_, HasSubstr("The gamepad is gone: the keys go on"));
  for (const char* folder : {"by-pointer", "by-stick"}) {
    const std::string record = file(std::string(folder) + "/match-1.keys");
    const game::KeyLog log = game::read_key_log(std::filesystem::path(record));
    EXPECT_TRUE(game::has_pushes(log)) << folder;
    EXPECT_TRUE(Played(record).is_as_recorded) << folder;
    double last_push_s = 0.0;
    for (const game::InputEvent& event : log.events)
      if (event.kind == game::InputKind::push) last_push_s = event.time;
    if (std::string_view(folder) == "by-stick") {
      EXPECT_LT(last_push_s, 1.1) << "the match begins after 3 s";
    }
  }
  EXPECT_EQ(play("--control mouse"), 2);
  EXPECT_THAT(said_, HasSubstr("--control"));
}

/// Each tap begins and ends in one frame; the menus see them one after the other.
TEST_F(PlayCommand, SeesKeysThatAreDownAndUpWithinOneFrame) {
  const auto tap = [](const std::string& key) {
    return "0.3 down " + key + "\n0.3 up " + key + "\n";
  };
  ASSERT_EQ(play("--records kept", tap("down") + tap("enter") + tap("down") + tap("enter") +
                                       "5 down w\n5 up w\n6 end\n"),
            0)
      << said_;
  const Played played(file("kept/match-1.keys"));
  EXPECT_EQ(played.own_keys, 2);
  ASSERT_FALSE(played.log.events.empty());
  std::vector<double> instants;
  for (const game::InputEvent& event : played.log.events)
    if (event.player == 0) instants.push_back(event.time);
  ASSERT_EQ(instants.size(), 2u);
  EXPECT_NEAR(instants[1] - instants[0], 1.0 / 60.0, 2e-3) << "the bat feels it for a frame";
}

/// Bats of a crowd that nobody plays stand where the scene put them, each in its team's colour.
TEST_F(PlayCommand, ShowsAWatcherEveryBatOfARunningServerWhereItIs) {
  game::Process server(
      test::binary_folder() + "/bin/rink-serve",
      {"--scene", "crowd", "--bat-count", "6", "--puck-count", "1", "--seed", "3", "--port", "0"},
      {});
  std::optional<std::string> place;
  for (int i = 0; i < 500 && !place; ++i)
    server.attend(std::chrono::milliseconds(10)), place = server.line_after("listening on ");
  ASSERT_TRUE(place) << server.stderr_tail();
  ASSERT_EQ(play("--camera above --watch " + *place, "1.5 tap i\n2 picture watched.png\n2.1 end\n"),
            0)
      << said_;
  EXPECT_EQ(said_, "");
  const Image picture = read_png(file("watched.png"));
  const game::Game game(
      game::chosen_scene({.scene = "crowd", .bat_count = 6, .puck_count = 1, .seed = 3}));
  const physics::Field& field = game.world().spec().field;
  const double aspect = static_cast<double>(picture.width) / picture.height;
  const Sight sight(camera_of(field, {.viewpoint = Viewpoint::above}, aspect),
                    static_cast<float>(aspect));
  for (std::uint32_t player = 0; player < 6; ++player) {
    const Vector2 at = game.position(*game.bat(player));
    const Eigen::Vector2f window =
        sight.project({static_cast<float>(at.x()), static_cast<float>(at.y()), 0.0f});
    const auto pixel_at = [&](int dx, int dy) {
      const int x =
          static_cast<int>((0.5 * static_cast<double>(window.x()) + 0.5) * picture.width) + dx;
      const int y =
          static_cast<int>((0.5 - 0.5 * static_cast<double>(window.y())) * picture.height) + dy;
      return static_cast<std::size_t>((y * picture.width + x) * picture.channels);
    };
    const bool is_red = game.entity(*game.bat(player)).team == game::Team::left;
    int most = -255;  // by how much the team's colour is stronger than the other's, in the pixels
                      // about the middle
    for (int dx = -2; dx <= 2; ++dx)
      for (int dy = -2; dy <= 2; ++dy) {
        const std::size_t pixel = pixel_at(dx, dy);
        const int red = picture.pixels[pixel], blue = picture.pixels[pixel + 2];
        most = std::max(most, is_red ? red - blue : blue - red);
      }
    EXPECT_GT(most, 60) << "bat " << player;
  }
}

TEST_F(PlayCommand, SaysWhatIsWrongWithTheSettings) {
  std::filesystem::create_directories(file("rink"));
  std::ofstream(file("rink/play.toml")) << "[keys.left]\nup = \"hyper\"\n";
  ASSERT_EQ(play("", "0.2 end\n"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("play.toml:2: there is no key 'hyper'"));
}

TEST_F(PlayCommand, GoesOnWhereNothingCanBeKept) {
  // Nobody, root neither, can make a folder below a file.
  std::ofstream(file("home")) << "no folder\n";
  const std::string nowhere = " --settings home/play.toml --records home/matches";
  ASSERT_EQ(play("--bot expert" + nowhere, "3.5 down w\n4 tap m\n5 end\n"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("cannot write the settings to 'home/play.toml'"));
  EXPECT_THAT(said_, HasSubstr("home/matches"));
  const test::ReservedPort port;
  ASSERT_EQ(play("--host " + port.text() + nowhere, "0.5 picture hosted.png\n"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("home/matches"));
  EXPECT_THAT(said_, Not(HasSubstr("cannot host")));
}

TEST_F(PlayCommand, KeepsTheRecordWhenItIsInterrupted) {
  std::ofstream(file("script")) << "4 picture playing.png\n1000000 end\n";
  const std::string command = "cd " + folder_.path().string() + " && { " + test::binary_folder() +
                              "/bin/rink-play --bot club --offscreen --size 320x240 --records kept "
                              "--script script & } 2>err\n" +
                              "for i in $(seq 200); do [ -e playing.png ] && break; sleep 0.05; "
                              "done; kill -INT $!; wait $!";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(std::filesystem::exists(file("kept/match-1.keys")));
}

TEST_F(PlayCommand, SavesAKeyThatWasBoundAnew) {
  // Settings are the sixth entry; the first button is the left player's left key.
  ASSERT_EQ(play("",
                 "0.2 tap down\n0.3 tap down\n0.4 tap down\n0.5 tap down\n0.6 tap down\n0.7 tap "
                 "enter\n0.9 tap space\n1.1 tap j\n1.4 end\n"),
            0)
      << said_;
  std::ostringstream words;
  words << std::ifstream(file("rink/play.toml")).rdbuf();
  EXPECT_THAT(words.str(), HasSubstr("[keys.left]\nleft = \"j\"\n"));
}

/// Nobody who watches a script has asked for anything to be kept, nor for a flag of one run.
TEST_F(PlayCommand, KeepsNeitherFlagsNorHintsThatNobodyAskedToKeep) {
  ASSERT_EQ(play("--bot club", "3.2 tap w\n3.4 tap c\n3.6 tap escape\n4 end\n"), 0) << said_;
  EXPECT_FALSE(std::filesystem::exists(file("rink/play.toml")));
  ASSERT_EQ(play("--mute",
                 "0.2 tap down\n0.3 tap down\n0.4 tap down\n0.5 tap down\n0.6 tap down\n0.7 tap "
                 "enter\n0.9 tap space\n1.1 tap j\n1.4 end\n"),
            0)
      << said_;
  EXPECT_THAT(test::text_of(file("rink/play.toml")),
              AllOf(HasSubstr("left = \"j\"\n"), HasSubstr("mute = false\n")));
}

TEST_F(PlayCommand, NeedsADisplayUnlessItDrawsOffscreen) {
  EXPECT_EQ(play("--two"), 18);
  EXPECT_THAT(said_, HasSubstr("xvfb"));
  EXPECT_EQ(play("--offscreen"), 2);
  EXPECT_EQ(play("--offscreen --screenshot a.png --size 9x9"), 2);
  EXPECT_EQ(play("--two --bot club"), 2);
  EXPECT_EQ(play("--host 99999"), 2);
  EXPECT_EQ(play("--offscreen --screenshot a.png --at nan"), 2);
  EXPECT_EQ(play("--peer 127.0.0.1:1 --two"), 2);
  EXPECT_EQ(play("--peer 127.0.0.1:1 --until 5"), 2) << "the first one's to say";
  EXPECT_EQ(play("--peers 3"), 2);
}

TEST_F(PlayCommand, SaysWhyAMatchCannotBePlayedAndGoesOnInTheMenu) {
  std::ofstream(file("altered.keys")) << "rink-keys 1\nscene match\n";
  const std::pair<const char*, const char*> cases[] = {
      {"--join 127.0.0.1:1", "Connection refused"},
      {"--join nowhere", "'nowhere' is not ADDRESS:PORT"},
      {"--peer 127.0.0.1:1", "no peer answers at 127.0.0.1:1: refused"},
      {"--peer 10.1.2.3:4800", "--peer-listen ADDRESS:0 is missing: with peers on other machines"},
      {"--peer-listen 0.0.0.0:0", "none can connect to 0.0.0.0"},
      {"--peer-listen 127.0.0.1:0 --window 0.5", "expected shorter ones"},
      {"--scene arena --peer-listen 127.0.0.1:0 --record no/folder",
       "--record: cannot write 'no/folder'"},
      {"--replay altered.keys", "altered.keys"},
      {"--replay missing.keys", "missing.keys"}};
  for (const auto& [arguments, words] : cases) {
    // Who asks for a peer asks for five seconds, lest it come too early.
    EXPECT_EQ(
        play(arguments, std::string(arguments) == "--peer 127.0.0.1:1" ? "5.8 end\n" : "0.3 end\n"),
        0)
        << arguments;
    EXPECT_THAT(said_, HasSubstr(words)) << arguments;
  }
  rti::TcpTransport other;
  EXPECT_EQ(play("--host " + std::to_string(other.listen("0.0.0.0", 0)), "0.3 end\n"), 0);
  EXPECT_THAT(said_, AllOf(HasSubstr("cannot host: "), HasSubstr("in use")));
}

TEST_F(PlayCommand, RecordsAMatchThatItsReplayShowsAsItWas) {
  ASSERT_EQ(play("--bot expert --records kept", "3.5 down w\n5 up w\n6 end\n"), 0) << said_;
  ASSERT_TRUE(std::filesystem::exists(file("kept/match-1.keys")));
  EXPECT_EQ(play("--replay kept/match-1.keys",
                 "1 picture a.png\n1.2 tap right\n1.4 tap space\n1.6 picture b.png\n"),
            0)
      << said_;
  EXPECT_EQ(said_, "");
  EXPECT_GT(difference(read_png(file("a.png")), read_png(file("b.png"))).mean, 0.05);
}

TEST_F(PlayCommand, IsOneOfTwoPeersWhoseRecordIsTheGameThatOneEnginePlays) {
  const test::ReservedPort port;
  std::ofstream(file("second")) << "4.5 down w\n4.9 up w\n9 end\n";
  const std::string joining =
      "cd " + folder_.path().string() +
      " && (for i in $(seq 100); do grep -q listening first_out 2>/dev/null && break; sleep 0.05; "
      "done; " +
      test::binary_folder() +
      "/bin/rink-play --offscreen --size 320x240 --scene arena --bats 8 --peer 127.0.0.1:" +
      port.text() +
      " --record second.keys --script second >second_out 2>&1; echo $? >second_status) &";
  ASSERT_EQ(std::system(joining.c_str()), 0);
  ASSERT_EQ(play("--scene arena --bats 8 --peer-listen 127.0.0.1:" + port.text() +
                     " --until 2.5 --record first.keys",
                 "4.6 down a\n5 up a\n7 picture over.png\n7.5 end\n", " >first_out"),
            0)
      << said_;
  for (int i = 0; i < 200 && !std::filesystem::exists(file("second_status")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::string first = test::text_of(file("first_out")),
                    second = test::text_of(file("second_out"));
  const game::KeyLog log = game::read_key_log(std::filesystem::path(file("first.keys")));
  EXPECT_EQ(log.events, game::read_key_log(std::filesystem::path(file("second.keys"))).events);
  EXPECT_EQ(log.events.size(), 4u) << first << second << said_;
  game::Game one(game::scaled_to_bats(game::load_scene("arena"), 8));
  for (const game::InputEvent& event : log.events) one.submit(event);
  one.advance(2.5);
  char hash[40];
  std::snprintf(hash, sizeof hash, "hash %016llx, 4 keys",
                static_cast<unsigned long long>(one.hash()));
  EXPECT_THAT(first, HasSubstr(hash));
  EXPECT_THAT(second, HasSubstr(hash));
}

class PlayCommandLong : public PlayCommand {};

TEST_F(PlayCommandLong, TwoWindowsPlayOneMatchUntilTheHostVanishes) {
  const test::ReservedPort port;
  std::ofstream(file("joining")) << "4.8 picture joined.png\n40 end\n";
  const std::string joining =
      "cd " + folder_.path().string() + " && (sleep 1; " + test::binary_folder() +
      "/bin/rink-play --offscreen --size 640x360 --join 127.0.0.1:" + port.text() +
      " --script joining 2>joined_err; echo $? >joined_status) &";
  ASSERT_EQ(std::system(joining.c_str()), 0);
  ASSERT_EQ(play("--host " + port.text() + " --records kept", "5.8 picture hosted.png\n7 end\n"), 0)
      << said_;
  for (int i = 0; i < 600 && !std::filesystem::exists(file("joined_status")); ++i)  // it waits 30 s
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_THAT(test::text_of(file("joined_err")), HasSubstr("The match cannot go on"));
  EXPECT_TRUE(std::filesystem::exists(file("kept/match-1.keys")));
  EXPECT_GT(difference(read_png(file("joined.png")), read_png(file("hosted.png"))).mean, 1.0)
      << "each sees it from the own end";
}

}  // namespace
}  // namespace rink::view
